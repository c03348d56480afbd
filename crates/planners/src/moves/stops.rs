use tolman_maze::Cell;

/// The `K` best stops offered, the best first. Of equally good stops, the first by
/// [`tolman_maze::Grid::index`] counts as better.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stops<const K: usize> {
    best: [Option<(f32, Cell)>; K],
}

impl<const K: usize> Stops<K> {
    pub(super) const fn new() -> Self {
        Self { best: [None; K] }
    }

    /// Keeps the stop if it is among the best so far.
    pub(super) fn offer(&mut self, score: f32, cell: Cell) {
        let mut offered = Some((score, cell));
        for slot in &mut self.best {
            let is_better = match (offered, *slot) {
                (Some((score, cell)), Some((held, beside))) => {
                    score > held || (score >= held && (cell.y, cell.x) < (beside.y, beside.x))
                }
                (offered, held) => offered.is_some() && held.is_none(),
            };
            if is_better {
                core::mem::swap(slot, &mut offered);
            }
        }
    }

    /// Returns the score above which a stop is kept.
    pub(super) fn lowest(&self) -> f32 {
        let last = self.best.last().copied().flatten();
        last.map_or(f32::NEG_INFINITY, |(score, _)| score)
    }

    pub(super) fn best(&self) -> Option<Cell> {
        self.iter().next()
    }

    /// Returns the best stop, if its score is above `score`.
    pub(super) fn best_above(&self, score: f32) -> Option<Cell> {
        let best = self.best.first().copied().flatten();
        best.filter(|(held, _)| *held > score).map(|(_, cell)| cell)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Cell> {
        self.best.iter().flatten().map(|(_, cell)| *cell)
    }
}
