use crate::{Cell, Direction, Grid};

/// Knowledge of one wall of a maze.
///
/// ```
/// use tolman_maze::Knowledge;
///
/// let seen = Knowledge::of_standing(true);
/// assert_eq!(seen, Knowledge::Wall);
/// assert!(seen.is_known() && !Knowledge::default().is_known());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Knowledge {
    /// The wall has not been seen yet.
    #[default]
    Unknown,
    /// No wall stands here.
    Open,
    /// A wall stands here.
    Wall,
}

impl Knowledge {
    /// Returns the knowledge of a wall that was seen to stand or not to stand.
    #[must_use]
    pub const fn of_standing(stands: bool) -> Self {
        if stands { Self::Wall } else { Self::Open }
    }

    /// Returns whether the wall has been seen.
    #[must_use]
    pub const fn is_known(self) -> bool {
        !matches!(self, Self::Unknown)
    }
}

/// The known part of a maze: everything that a planner or a search asks of a map.
///
/// A [`Maze`](crate::Maze) is one in which everything is known. Beyond the grid, and on its border,
/// every wall stands.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
///
/// /// A maze nobody has seen yet.
/// struct Dark(Grid);
///
/// impl Walls for Dark {
///     fn grid(&self) -> Grid {
///         self.0
///     }
///
///     fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
///         match self.0.neighbour(cell, direction) {
///             Some(_) => Knowledge::Unknown,
///             None => Knowledge::Wall,
///         }
///     }
/// }
///
/// let dark = Dark(Grid::new(16, 16));
/// assert_eq!(dark.knowledge(Cell::new(0, 0), Direction::North), Knowledge::Unknown);
/// assert_eq!(dark.knowledge(Cell::new(0, 0), Direction::West), Knowledge::Wall);
/// ```
pub trait Walls {
    /// Returns size and wall numbering.
    fn grid(&self) -> Grid;

    /// Returns the knowledge of the `direction` side of `cell`; the same from both sides of a wall.
    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge;
}

impl<W: Walls + ?Sized> Walls for &W {
    fn grid(&self) -> Grid {
        (**self).grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        (**self).knowledge(cell, direction)
    }
}

#[cfg(feature = "alloc")]
impl Walls for crate::Maze {
    fn grid(&self) -> Grid {
        self.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let open = self.grid().contains(cell) && self.is_open(cell, direction);
        Knowledge::of_standing(!open)
    }
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    use super::*;
    use crate::Maze;

    #[test]
    fn of_a_maze_everything_is_known() {
        let mut maze = Maze::open(Grid::new(3, 2));
        maze.set_wall(Cell::new(0, 0), Direction::East, true);
        for cell in maze.grid().cells() {
            for direction in Direction::ALL {
                let known = maze.knowledge(cell, direction);
                assert_eq!(known == Knowledge::Open, maze.is_open(cell, direction));
                assert!(known.is_known());
            }
        }
        let beyond = Cell::new(7, 7);
        assert_eq!(
            (&&maze).knowledge(beyond, Direction::North),
            Knowledge::Wall
        );
    }
}
