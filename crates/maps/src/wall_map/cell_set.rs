use tolman_maze::Cell;

/// A set of cells of a maze of at most `N` × `N`: one bit a cell.
///
/// ```
/// use tolman_maps::wall_map::CellSet;
/// use tolman_maze::Cell;
///
/// let mut set = CellSet::<16>::default();
/// set.insert(Cell::new(3, 5));
/// assert!(set.contains(Cell::new(3, 5)) && set.len() == 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellSet<const N: usize> {
    /// By y; bit x.
    rows: [u32; N],
}

impl<const N: usize> Default for CellSet<N> {
    /// The empty set.
    fn default() -> Self {
        Self { rows: [0; N] }
    }
}

impl<const N: usize> CellSet<N> {
    /// Adds a cell. Cells beyond `N` × `N` are left out.
    pub fn insert(&mut self, cell: Cell) {
        if let Some(row) = self.rows.get_mut(usize::from(cell.y)) {
            *row |= bit::<N>(cell.x);
        }
    }

    /// Whether the cell is in the set.
    #[must_use]
    pub fn contains(&self, cell: Cell) -> bool {
        let row = self.rows.get(usize::from(cell.y));
        row.is_some_and(|row| row & bit::<N>(cell.x) != 0)
    }

    /// How many cells are in the set.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.iter().map(|row| row.count_ones() as usize).sum()
    }

    /// Whether no cell is in the set.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.iter().all(|row| *row == 0)
    }
}

impl<const N: usize> Extend<Cell> for CellSet<N> {
    fn extend<T: IntoIterator<Item = Cell>>(&mut self, cells: T) {
        for cell in cells {
            self.insert(cell);
        }
    }
}

impl<const N: usize> FromIterator<Cell> for CellSet<N> {
    fn from_iter<T: IntoIterator<Item = Cell>>(cells: T) -> Self {
        let mut set = Self::default();
        set.extend(cells);
        set
    }
}

/// Bit `x` of a row, none beyond the `N`th column.
const fn bit<const N: usize>(x: u16) -> u32 {
    if (x as usize) < N && x < 32 {
        1 << x
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_beyond_are_left_out() {
        let set: CellSet<4> = [(0, 0), (3, 3), (4, 0), (0, 4), (40, 1)]
            .map(|(x, y)| Cell::new(x, y))
            .into_iter()
            .collect();
        assert_eq!(set.len(), 2);
        assert!(!set.contains(Cell::new(4, 0)) && !set.contains(Cell::new(40, 1)));
        assert!(!set.is_empty() && CellSet::<4>::default().is_empty());
    }
}
