use crate::{Cell, Direction};

/// One edge of the grid: the border between two cells, or between a cell and the outside.
///
/// Ids are dense: first the vertical edges row by row from the south-west, then the horizontal ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wall(pub u32);

/// The size of a maze, and with it the numbering of its walls. Needs no memory of its own.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid};
///
/// let grid = Grid::new(16, 16);
/// let here = Cell::new(3, 5);
/// let east = grid.neighbour(here, Direction::East).unwrap();
/// // Both sides of an edge are the same wall.
/// assert_eq!(grid.wall(here, Direction::East), grid.wall(east, Direction::West));
/// assert_eq!(grid.wall_count(), 2 * 16 * 17);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Grid {
    width: u16,
    height: u16,
}

impl Grid {
    /// A grid of `width` columns and `height` rows.
    #[must_use]
    pub const fn new(width: u16, height: u16) -> Self {
        Self { width, height }
    }

    /// Columns.
    #[must_use]
    pub const fn width(self) -> u16 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(self) -> u16 {
        self.height
    }

    /// How many cells.
    #[must_use]
    pub const fn cell_count(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// How many walls could stand, the border's included.
    #[must_use]
    pub const fn wall_count(self) -> usize {
        self.vertical_count() + self.width as usize * (self.height as usize + 1)
    }

    const fn vertical_count(self) -> usize {
        (self.width as usize + 1) * self.height as usize
    }

    /// Whether `cell` lies on the grid.
    #[must_use]
    pub const fn contains(self, cell: Cell) -> bool {
        cell.x < self.width && cell.y < self.height
    }

    /// The position of `cell` in row-major order from the south-west.
    #[must_use]
    pub const fn index(self, cell: Cell) -> usize {
        cell.y as usize * self.width as usize + cell.x as usize
    }

    /// All cells in the order of [`Grid::index`].
    pub fn cells(self) -> impl Iterator<Item = Cell> {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| Cell::new(x, y)))
    }

    /// The edge of `cell` that looks to `direction`. `cell` must lie on the grid.
    #[must_use]
    pub const fn wall(self, cell: Cell, direction: Direction) -> Wall {
        let (x, y) = (cell.x as usize, cell.y as usize);
        let (width, vertical) = (self.width as usize, self.vertical_count());
        let id = match direction {
            Direction::West => y * (width + 1) + x,
            Direction::East => y * (width + 1) + x + 1,
            Direction::South => vertical + y * width + x,
            Direction::North => vertical + (y + 1) * width + x,
        };
        Wall(id as u32)
    }

    /// The cell beyond the `direction` edge of `cell`, or none outside the grid.
    #[must_use]
    pub fn neighbour(self, cell: Cell, direction: Direction) -> Option<Cell> {
        let (east, north) = direction.step();
        let x = cell.x.checked_add_signed(i16::from(east))?;
        let y = cell.y.checked_add_signed(i16::from(north))?;
        let next = Cell::new(x, y);
        self.contains(next).then_some(next)
    }
}
