use super::wall_grid::GridIndex;

/// A rectangle of grid cells, which are numbered row by row from its first cell on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct GridArea {
    first: GridIndex,
    columns: i32,
    rows: i32,
}

impl GridArea {
    /// Returns the area of `columns` columns and `rows` rows from the cell `first` on.
    pub(super) const fn new(first: GridIndex, columns: i32, rows: i32) -> Self {
        Self {
            first,
            columns,
            rows,
        }
    }

    /// Returns the area from its first cell to the one beyond its last.
    pub(super) const fn between([first, end]: [GridIndex; 2]) -> Self {
        Self::new(first, end[0] - first[0], end[1] - first[1])
    }

    /// Returns the first cell, and the one beyond the last.
    pub(super) const fn bounds(&self) -> [GridIndex; 2] {
        let [column, row] = self.first;
        [self.first, [column + self.columns, row + self.rows]]
    }

    /// Returns the number of cells.
    pub(super) const fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Returns the cells, row by row.
    pub(super) fn indices(&self) -> impl Iterator<Item = GridIndex> + use<> {
        let [first, end] = self.bounds();
        let row = move |row| (first[0]..end[0]).map(move |column| [column, row]);
        (first[1]..end[1]).flat_map(row)
    }

    /// Returns the number of a cell, or `None` if it is outside.
    pub(super) fn slot(&self, [column, row]: GridIndex) -> Option<usize> {
        let [column, row] = [column - self.first[0], row - self.first[1]];
        let is_inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        is_inside.then(|| row as usize * self.columns as usize + column as usize)
    }

    /// Returns the cell of a number.
    pub(super) const fn index(&self, slot: usize) -> GridIndex {
        let columns = self.columns as usize;
        let [column, row] = [(slot % columns) as i32, (slot / columns) as i32];
        [self.first[0] + column, self.first[1] + row]
    }
}
