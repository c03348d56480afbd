use tolman_maze::Cell;

/// A set of cells of a maze of up to `N` × `N`, `N` ≤ 32. A row is one word, so that a whole row is
/// moved or compared at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CellSet<const N: usize> {
    /// Rows of cells, by y. Bit x is the cell in column x.
    pub(super) rows: [u32; N],
}

/// Masks of one cell, by x. A shift by x would give the same, but not for several cells at once.
const BITS: [u32; 32] = {
    let (mut bits, mut x) = ([1; 32], 1);
    while x < 32 {
        bits[x] = bits[x - 1] << 1;
        x += 1;
    }
    bits
};

impl<const N: usize> CellSet<N> {
    pub(super) const EMPTY: Self = {
        assert!(N <= 32, "a row of cells is a word of 32 bits");
        Self { rows: [0; N] }
    };

    /// Returns the `cells` that lie within `N` × `N`.
    pub(super) fn of(cells: impl IntoIterator<Item = Cell>) -> Self {
        let mut set = Self::EMPTY;
        for cell in cells {
            set.insert(cell);
        }
        set
    }

    pub(super) fn insert(&mut self, cell: Cell) {
        if let (Some(row), true) = (self.rows.get_mut(usize::from(cell.y)), cell.x < 32) {
            *row |= 1 << cell.x;
        }
    }

    pub(super) fn remove(&mut self, cell: Cell) {
        if let (Some(row), true) = (self.rows.get_mut(usize::from(cell.y)), cell.x < 32) {
            *row &= !(1 << cell.x);
        }
    }

    pub(super) fn contains(&self, cell: Cell) -> bool {
        let row = self.rows.get(usize::from(cell.y)).copied().unwrap_or(0);
        cell.x < 32 && row >> cell.x & 1 == 1
    }

    /// Returns the cells for whose value a predicate holds.
    pub(super) fn filter(values: &[[u16; N]; N], holds: impl Fn(u16) -> bool) -> Self {
        let mut set = Self::EMPTY;
        for (row, values) in set.rows.iter_mut().zip(values) {
            let bits = BITS.iter().zip(values);
            *row = bits.fold(0, |row, (bit, value)| {
                row | if holds(*value) { *bit } else { 0 }
            });
        }
        set
    }

    /// Gives the cells of the set a value, and returns their number.
    pub(super) fn fill(&self, values: &mut [[u16; N]; N], value: u16) -> u16 {
        let mut cells = 0;
        for (row, values) in self.rows.iter().zip(values) {
            let mut left = *row;
            while left != 0 {
                if let Some(slot) = values.get_mut(left.trailing_zeros() as usize) {
                    *slot = value;
                }
                left &= left - 1;
                cells += 1;
            }
        }
        cells
    }

    /// Gives all other cells a value.
    pub(super) fn fill_others(&self, values: &mut [[u16; N]; N], other: u16) {
        for (row, values) in self.rows.iter().zip(values) {
            for (bit, value) in BITS.iter().zip(values) {
                *value = if row & bit == 0 { other } else { *value };
            }
        }
    }

    pub(super) fn len(&self) -> u32 {
        self.rows.iter().map(|row| row.count_ones()).sum()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.iter().fold(0, |all, row| all | row) == 0
    }

    pub(super) fn or(&self, other: &Self) -> Self {
        self.with(other, |row, other| row | other)
    }

    pub(super) fn and(&self, other: &Self) -> Self {
        self.with(other, |row, other| row & other)
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.with(other, |row, other| row & !other)
    }

    /// Returns the set whose rows `each` makes from the rows of the two sets.
    #[inline(always)]
    fn with(mut self, other: &Self, each: impl Fn(u32, u32) -> u32) -> Self {
        for (row, other) in self.rows.iter_mut().zip(&other.rows) {
            *row = each(*row, *other);
        }
        self
    }

    /// Returns the cells row by row from the south, each from the west: in the order of
    /// [`tolman_maze::Grid::index`].
    pub(super) const fn iter(&self) -> Cells<N> {
        Cells {
            rows: self.rows,
            y: 0,
        }
    }
}

/// The cells of a [`CellSet`].
#[derive(Clone, Debug)]
pub(super) struct Cells<const N: usize> {
    /// Rows of the cells that are still to come.
    rows: [u32; N],
    y: u16,
}

impl<const N: usize> Iterator for Cells<N> {
    type Item = Cell;

    fn next(&mut self) -> Option<Cell> {
        loop {
            let row = self.rows.get_mut(usize::from(self.y))?;
            if *row != 0 {
                let x = row.trailing_zeros() as u16;
                *row &= *row - 1;
                return Some(Cell::new(x, self.y));
            }
            self.y += 1;
        }
    }

    /// Folds over all cells in one loop, which is faster than cell by cell.
    fn fold<B, F: FnMut(B, Cell) -> B>(self, init: B, mut each: F) -> B {
        let mut folded = init;
        for (y, row) in (0..).zip(self.rows) {
            let mut left = row;
            while left != 0 {
                folded = each(folded, Cell::new(left.trailing_zeros() as u16, y));
                left &= left - 1;
            }
        }
        folded
    }
}
