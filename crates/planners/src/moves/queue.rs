use tolman_maze::Cell;

/// First in, first out, for a search that queues every cell once at most.
pub(super) struct Queue<const N: usize> {
    cells: [[Cell; N]; N],
    first: usize,
    end: usize,
}

impl<const N: usize> Queue<N> {
    pub(super) const fn new() -> Self {
        Self {
            cells: [[Cell::new(0, 0); N]; N],
            first: 0,
            end: 0,
        }
    }

    pub(super) fn push(&mut self, cell: Cell) {
        if let Some(slot) = self.cells.as_flattened_mut().get_mut(self.end) {
            *slot = cell;
            self.end += 1;
        }
    }

    pub(super) fn pop(&mut self) -> Option<Cell> {
        if self.first == self.end {
            return None;
        }
        let cell = self.cells.as_flattened().get(self.first).copied();
        self.first += 1;
        cell
    }
}
