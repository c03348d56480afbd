//! Where a mouse of mms can be: on a lattice of half-steps.

use tolman_maze::{Cell, Direction, Maze};

/// A place on the lattice of half-steps, from the south-west corner: middles of cells have two odd
/// coordinates, middles of walls one, posts none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Half-steps to the east.
    pub x: u32,
    /// Half-steps to the north.
    pub y: u32,
}

impl Place {
    /// The middle of the south-west cell, where every mouse of mms starts.
    pub const START: Self = Self { x: 1, y: 1 };

    /// The cell it lies in; that to the north and east of it on a wall.
    #[must_use]
    pub const fn cell(self) -> Cell {
        Cell::new((self.x / 2) as u16, (self.y / 2) as u16)
    }

    /// The place half a step on.
    #[must_use]
    pub const fn ahead(self, heading: Heading) -> Self {
        let (east, north) = heading.half_step();
        Self {
            x: self.x.wrapping_add_signed(east),
            y: self.y.wrapping_add_signed(north),
        }
    }

    /// Whether a wall or a post stands half a step ahead.
    #[must_use]
    pub fn is_blocked(self, heading: Heading, maze: &Maze) -> bool {
        let Self { x, y } = self.ahead(heading);
        let (width, height) = (maze.grid().width(), maze.grid().height());
        let inside = |at: u32, cells: u16| at > 0 && at < 2 * u32::from(cells);
        if !inside(x, width) || !inside(y, height) {
            return true;
        }
        let cell = Self { x, y }.cell();
        match (x % 2, y % 2) {
            (0, 0) => true,
            (0, _) => !maze.is_open(cell, Direction::West),
            (_, 0) => !maze.is_open(cell, Direction::South),
            _ => false,
        }
    }
}

/// One of the eight directions a mouse of mms can look: eighths of a circle, clockwise from north.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heading(u8);

impl Heading {
    /// Where every mouse looks at the start.
    pub const NORTH: Self = Self(0);

    /// Turned by so many eighths of a circle, clockwise.
    #[must_use]
    pub const fn turned(self, eighths: i8) -> Self {
        Self((self.0 as i8 + eighths).rem_euclid(8) as u8)
    }

    /// Half a step that way: to the east, to the north.
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
