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

#[cfg(test)]
mod tests {
    extern crate alloc;

    use alloc::vec::Vec;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// All offers sorted, and the first of them kept.
        #[test]
        fn the_best_are_kept_in_order(
            offers in prop::collection::vec((0..6_u16, (0..9_u16, 0..9_u16)), 0..12),
            above in 0..6_u16,
        ) {
            let mut stops = Stops::<4>::new();
            let mut all: Vec<(f32, Cell)> = Vec::new();
            for (score, (x, y)) in offers {
                let (score, cell) = (f32::from(score), Cell::new(x, y));
                if all.iter().any(|(_, known)| *known == cell) {
                    continue;
                }
                stops.offer(score, cell);
                all.push((score, cell));
            }
            all.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1.y, a.1.x).cmp(&(b.1.y, b.1.x))));
            all.truncate(4);
            let cells: Vec<Cell> = all.iter().map(|(_, cell)| *cell).collect();
            prop_assert_eq!(stops.iter().collect::<Vec<_>>(), cells.clone());
            prop_assert_eq!(stops.best(), cells.first().copied());
            let lowest = all.get(3).map_or(f32::NEG_INFINITY, |(score, _)| *score);
            prop_assert_eq!(stops.lowest().to_bits(), lowest.to_bits());
            let above = f32::from(above);
            let best = all.first().filter(|(score, _)| *score > above);
            prop_assert_eq!(stops.best_above(above), best.map(|(_, cell)| *cell));
        }
    }
}
