//! Turns a maze by a quarter, or mirrors it.

use crate::{Cell, Direction, Grid};

/// A motion of a maze onto itself or onto one that lies across.
#[derive(Clone, Copy)]
pub(crate) enum Motion {
    /// A quarter turn clockwise.
    Quarter,
    /// West and east change sides.
    Mirror,
}

impl Motion {
    pub(crate) const fn grid(self, grid: Grid) -> Grid {
        match self {
            Self::Quarter => Grid::new(grid.height(), grid.width()),
            Self::Mirror => grid,
        }
    }

    /// Returns where a cell of `grid` comes to.
    pub(crate) const fn cell(self, grid: Grid, cell: Cell) -> Cell {
        let from_the_east = grid.width() - 1 - cell.x;
        match self {
            Self::Quarter => Cell::new(cell.y, from_the_east),
            Self::Mirror => Cell::new(from_the_east, cell.y),
        }
    }

    pub(crate) const fn direction(self, direction: Direction) -> Direction {
        match (self, direction) {
            (Self::Quarter, _) => direction.right(),
            (Self::Mirror, Direction::East | Direction::West) => direction.opposite(),
            (Self::Mirror, _) => direction,
        }
    }
}
