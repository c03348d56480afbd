//! Positions of a mouse on a lattice of half-steps, half a cell each.

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
    /// The middle of the south-west cell.
    pub const START: Self = Self { x: 1, y: 1 };

    /// Returns the cell of the point; on a wall, the cell to its north or east.
    #[must_use]
    pub const fn cell(self) -> Cell {
        Cell::new((self.x / 2) as u16, (self.y / 2) as u16)
    }

    /// Returns the place half a step on.
    #[must_use]
    pub const fn ahead(self, heading: LatticeHeading) -> Self {
        self.moved(heading.half_step())
    }

    /// Returns the point that lies some half-steps to the east and to the north. Points in the west
    /// and south of the lattice are farther away than any cell.
    #[must_use]
    pub const fn moved(self, (east, north): (i32, i32)) -> Self {
        Self {
            x: self.x.wrapping_add_signed(east),
            y: self.y.wrapping_add_signed(north),
        }
    }

    /// Returns the obstacle half a step ahead of a mouse.
    #[must_use]
    pub fn gate(self, heading: LatticeHeading, grid: Grid) -> Gate {
        self.ahead(heading).obstacle(grid)
    }

    /// Returns the obstacle at this point.
    #[must_use]
    pub fn obstacle(self, grid: Grid) -> Gate {
        let Self { x, y } = self;
        let inside = |at: u32, cells: u16| at > 0 && at < 2 * u32::from(cells);
        if !inside(x, grid.width()) || !inside(y, grid.height()) {
            return Gate::Solid;
        }
        let cell = self.cell();
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

/// Obstacle at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// None: the point is the middle of a cell.
    None,
    /// The side of a cell, with a wall or without.
    Edge(Cell, Direction),
    /// A post, or the border.
    Solid,
}

/// One of the eight directions on the lattice: eighths of a circle, clockwise from north.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticeHeading(u8);

impl LatticeHeading {
    /// The heading to the north.
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

    /// Returns the heading towards a side of a cell.
    #[must_use]
    pub const fn towards(side: Direction) -> Self {
        Self(2 * side.index() as u8)
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
    #[must_use]
    pub const fn half_step(self) -> (i32, i32) {
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

/// A place and a heading: the beginning or end of a movement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticePose {
    /// Place of the mouse.
    pub place: LatticePoint,
    /// Heading of the mouse.
    pub heading: LatticeHeading,
}

impl LatticePose {
    /// The pose in the south-west cell, looking north, where every mouse of mms starts.
    pub const START: Self = Self {
        place: LatticePoint::START,
        heading: LatticeHeading::NORTH,
    };

    /// Returns the number of poses on the lattice of a grid.
    #[must_use]
    pub const fn count(grid: Grid) -> u32 {
        columns(grid) * (2 * grid.height() as u32 + 1) * 8
    }

    /// Returns the number of the pose on the lattice of a grid, below [`LatticePose::count`].
    #[must_use]
    pub const fn index(self, grid: Grid) -> u32 {
        (self.place.y * columns(grid) + self.place.x) * 8 + self.heading.index()
    }

    /// Returns the pose with this [`LatticePose::index`].
    #[must_use]
    pub const fn from_index(index: u32, grid: Grid) -> Self {
        let place = index / 8;
        Self {
            place: LatticePoint {
                x: place % columns(grid),
                y: place / columns(grid),
            },
            heading: LatticeHeading::from_index(index % 8),
        }
    }
}

const fn columns(grid: Grid) -> u32 {
    2 * grid.width() as u32 + 1
}
