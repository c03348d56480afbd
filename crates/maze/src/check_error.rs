use crate::{Cell, Direction, Grid};

/// Reason why a robot cannot be sent through a maze; see [`Maze::check`](crate::Maze::check).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The grid has no cell at all.
    #[error("the maze has no cells: give it at least one column and one row")]
    NoCells,
    /// The border has an opening, through which a robot could leave the maze.
    #[error("the border of cell {cell} is open to the {direction}: close it with a wall")]
    OpenBorder {
        /// Cell at the border.
        cell: Cell,
        /// Side of the cell that must be closed.
        direction: Direction,
    },
    /// No cell is marked as the goal.
    #[error("the maze has no goal: mark at least one cell as the destination")]
    NoGoal,
    /// The start is not a cell of the maze.
    #[error(
        "the start {start} lies outside the maze: columns run from 0 to {}, rows from 0 to {}",
        grid.width().saturating_sub(1), grid.height().saturating_sub(1)
    )]
    StartOutside {
        /// Start that was given.
        start: Cell,
        /// Size of the maze.
        grid: Grid,
    },
    /// A goal is not a cell of the maze.
    #[error(
        "the goal {goal} lies outside the maze: columns run from 0 to {}, rows from 0 to {}",
        grid.width().saturating_sub(1), grid.height().saturating_sub(1)
    )]
    GoalOutside {
        /// Goal that was given.
        goal: Cell,
        /// Size of the maze.
        grid: Grid,
    },
    /// Walls separate the start from every goal.
    #[error("no way leads from the start {start} to the goal {goal}: open a wall between them")]
    NoWay {
        /// Start of the runs.
        start: Cell,
        /// First of the goals.
        goal: Cell,
    },
    /// The maze has no start, and all four walls of every goal stand.
    #[error("the goal {goal} is walled in on all four sides: open one of its walls")]
    Enclosed {
        /// First of the goals.
        goal: Cell,
    },
}

impl CheckError {
    /// Returns the cell with the fault, or `None` if the fault concerns no single cell.
    pub(crate) const fn cell(self) -> Option<Cell> {
        match self {
            Self::OpenBorder { cell, .. } => Some(cell),
            Self::NoWay { goal, .. } | Self::Enclosed { goal } => Some(goal),
            Self::NoCells | Self::NoGoal | Self::StartOutside { .. } | Self::GoalOutside { .. } => {
                None
            }
        }
    }
}
