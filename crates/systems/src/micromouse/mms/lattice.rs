//! Positions of a mouse of mms: a lattice of half-steps.

use tolman_maze::{Cell, Direction, Grid};

/// A point on the lattice of half-steps, from the south-west corner. Middles of cells have two odd
/// coordinates, middles of walls one, posts none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticePoint {
    /// Half-steps to the east.
    pub x: u32,
    /// Half-steps to the north.
    pub y: u32,
}

impl LatticePoint {
    /// The middle of the south-west cell, where every mouse of mms starts.
    pub const START: Self = Self { x: 1, y: 1 };

    /// Returns the cell of the point; on a wall, the cell to its north or east.
    #[must_use]
    pub const fn cell(self) -> Cell {
        Cell::new((self.x / 2) as u16, (self.y / 2) as u16)
    }

    /// Returns the place half a step on.
    #[must_use]
    pub const fn ahead(self, heading: LatticeHeading) -> Self {
        let (east, north) = heading.half_step();
        Self {
            x: self.x.wrapping_add_signed(east),
            y: self.y.wrapping_add_signed(north),
        }
    }

    /// Returns the obstacle half a step ahead of a mouse.
    #[must_use]
    pub fn gate(self, heading: LatticeHeading, grid: Grid) -> Gate {
        let Self { x, y } = self.ahead(heading);
        let inside = |at: u32, cells: u16| at > 0 && at < 2 * u32::from(cells);
        if !inside(x, grid.width()) || !inside(y, grid.height()) {
            return Gate::Solid;
        }
        let cell = Self { x, y }.cell();
        match (x % 2, y % 2) {
            (0, 0) => Gate::Solid,
            (0, _) => Gate::Edge(cell, Direction::West),
            (_, 0) => Gate::Edge(cell, Direction::South),
            _ => Gate::None,
        }
    }

    /// Returns the middle of a cell.
    #[must_use]
    pub const fn middle_of(cell: Cell) -> Self {
        Self {
            x: 2 * cell.x as u32 + 1,
            y: 2 * cell.y as u32 + 1,
        }
    }
}

/// Obstacle half a step ahead of a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// None: the position ahead is the middle of a cell.
    None,
    /// The side of a cell, with a wall or without.
    Edge(Cell, Direction),
    /// A post, or the border.
    Solid,
}

/// One of the eight directions in which a mouse of mms can look: eighths of a circle, clockwise
/// from north.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticeHeading(u8);

impl LatticeHeading {
    /// Heading of every mouse at the start.
    pub const NORTH: Self = Self(0);

    /// Returns the heading turned clockwise by `eighths` eighths of a circle.
    #[must_use]
    pub const fn turned(self, eighths: i8) -> Self {
        Self((self.0 as i8 + eighths).rem_euclid(8) as u8)
    }

    /// Returns the side of a cell in this direction, or `None` on a diagonal.
    #[must_use]
    pub const fn side(self) -> Option<Direction> {
        match self.0 {
            0 => Some(Direction::North),
            2 => Some(Direction::East),
            4 => Some(Direction::South),
            6 => Some(Direction::West),
            _ => None,
        }
    }

    /// Returns the heading's number: 0 for north, then clockwise by eighths.
    #[must_use]
    pub const fn index(self) -> u32 {
        self.0 as u32
    }

    /// Returns the heading with this [`LatticeHeading::index`].
    #[must_use]
    pub const fn from_index(index: u32) -> Self {
        Self((index % 8) as u8)
    }

    /// Returns the displacement of half a step in that direction, to the east and to the north.
    const fn half_step(self) -> (i32, i32) {
        match self.0 {
            0 => (0, 1),
            1 => (1, 1),
            2 => (1, 0),
            3 => (1, -1),
            4 => (0, -1),
            5 => (-1, -1),
            6 => (-1, 0),
            _ => (-1, 1),
        }
    }
}
