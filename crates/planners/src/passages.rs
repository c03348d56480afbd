mod dead_ends;

use tolman_maze::{Cell, Direction, Knowledge, Walls};

use crate::TooLarge;

/// Edges of a maze of up to `N` × `N` cells, `N` ≤ 255, that a plan may cross: the input of
/// planners. One byte a cell. A larger `N` does not compile:
///
/// ```compile_fail
/// # use tolman_maze::{Grid, Maze};
/// # use tolman_planners::{Passages, Unknown};
/// Passages::<300>::new(&Maze::open(Grid::new(3, 1)), Unknown::Closed).ok();
/// ```
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Maze};
/// use tolman_planners::{Passages, Unknown};
///
/// let mut maze = Maze::open(Grid::new(3, 1));
/// maze.set_wall(Cell::new(1, 0), Direction::East, true);
/// let passages = Passages::<16>::new(&maze, Unknown::Closed)?;
/// assert!(passages.is_open(Cell::new(1, 0), Direction::West));
/// assert!(!passages.is_open(Cell::new(1, 0), Direction::East));
/// assert!(!passages.is_open(Cell::new(0, 0), Direction::West), "the border is closed");
/// # Ok::<(), tolman_planners::TooLarge>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passages<const N: usize> {
    /// Bit [`Direction::index`] of a cell, row by row from the south: open to that side.
    sides: [[u8; N]; N],
}

/// Treatment of unknown walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Unknown {
    /// Open: no way in the maze is shorter than the shortest way with these passages.
    Open,
    /// Closed: every way with these passages exists in the maze.
    Closed,
}

impl Unknown {
    /// Returns whether a plan may cross a wall of which this is known.
    fn is_open(self, known: Knowledge) -> bool {
        match known {
            Knowledge::Open => true,
            Knowledge::Wall => false,
            Knowledge::Unknown => self == Self::Open,
        }
    }
}

/// Returns the sides that a plan may cross, each as the northern or eastern one of a cell.
///
/// # Errors
/// If the maze has more than `N` columns or rows.
pub(crate) fn open_sides<const N: usize>(
    walls: &impl Walls,
    unknown: Unknown,
) -> Result<impl Iterator<Item = (Cell, Direction)>, TooLarge> {
    let grid = walls.grid();
    TooLarge::check(grid, N)?;
    let sides = grid
        .cells()
        .flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)]);
    Ok(sides.filter(move |(cell, direction)| {
        unknown.is_open(walls.knowledge(*cell, *direction))
            && grid.neighbour(*cell, *direction).is_some()
    }))
}

impl<const N: usize> Passages<N> {
    /// Returns the known passages of a maze. O(N²).
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn new(walls: &impl Walls, unknown: Unknown) -> Result<Self, TooLarge> {
        const { assert!(N <= 255, "16 bits count the steps through all cells") };
        let mut passages = Self::CLOSED;
        passages.take(walls, unknown)?;
        Ok(passages)
    }

    /// Nothing is open.
    pub(crate) const CLOSED: Self = Self { sides: [[0; N]; N] };

    /// Opens the known passages of a maze. In a small stack there is no room for a second copy, as
    /// [`new`](Self::new) has it.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub(crate) fn take(&mut self, walls: &impl Walls, unknown: Unknown) -> Result<(), TooLarge> {
        let grid = walls.grid();
        TooLarge::check(grid, N)?;
        // Chips do this at every decision, and plain loops take a third of what iterators take.
        for y in 0..grid.height() {
            for x in 0..grid.width() {
                let cell = Cell::new(x, y);
                if x + 1 < grid.width() && unknown.is_open(walls.knowledge(cell, Direction::East)) {
                    self.open_side(cell, Direction::East);
                    self.open_side(Cell::new(x + 1, y), Direction::West);
                }
                if y + 1 < grid.height() && unknown.is_open(walls.knowledge(cell, Direction::North))
                {
                    self.open_side(cell, Direction::North);
                    self.open_side(Cell::new(x, y + 1), Direction::South);
                }
            }
        }
        Ok(())
    }

    fn open_side(&mut self, cell: Cell, direction: Direction) {
        self.mark(cell, 1 << direction.index());
    }

    /// Sets these bits of a cell.
    fn mark(&mut self, cell: Cell, bits: u8) {
        let row = self.sides.get_mut(usize::from(cell.y));
        if let Some(sides) = row.and_then(|row| row.get_mut(usize::from(cell.x))) {
            *sides |= bits;
        }
    }

    /// Returns whether a plan may go from `cell` to `direction`. Nothing is open outside the maze.
    #[must_use]
    pub fn is_open(&self, cell: Cell, direction: Direction) -> bool {
        let row = self.sides.get(usize::from(cell.y));
        row.and_then(|row| row.get(usize::from(cell.x)))
            .is_some_and(|sides| sides >> direction.index() & 1 == 1)
    }

    /// Returns whether everything open here is also open in `other`.
    #[must_use]
    pub fn is_within(&self, other: &Self) -> bool {
        let (ours, theirs) = (self.sides(), other.sides());
        ours.iter()
            .zip(theirs)
            .all(|(ours, theirs)| ours & !theirs == 0)
    }

    /// Returns the open sides of every cell, row by row from the south.
    pub(crate) const fn sides(&self) -> &[u8] {
        self.sides.as_flattened()
    }
}
