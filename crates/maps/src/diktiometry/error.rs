use thiserror::Error;
use tolman_geom::PoseBox;

use super::{Action, DiktiometryConfigError};

/// Reason why a move is refused. The observer is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ObservedMoveError {
    /// The robot has no such action.
    #[error("action {} is not one of the {actions} of the configuration; count from 0", action.0)]
    UnknownAction {
        /// Action that the move names.
        action: Action,
        /// Number of actions in the configuration.
        actions: usize,
    },
    /// An exit names no action.
    #[error("exit {} is not one of the {actions} actions of the configuration; count from 0", action.0)]
    UnknownExit {
        /// Action that the exits name.
        action: Action,
        /// Number of actions in the configuration.
        actions: usize,
    },
    /// The odometry has an infinite bound.
    #[error(
        "the odometry {odometry:?} has an infinite bound; give a finite one, or report no move until the robot has one"
    )]
    Unbounded {
        /// Odometry of the move.
        odometry: PoseBox,
    },
    /// The percept is not of the configured form.
    #[error(
        "the percept has {rows} rows and {columns} columns; give {expected_rows} and {expected_columns}, as configured"
    )]
    PerceptSize {
        /// Number of rows of the percept.
        rows: usize,
        /// Number of columns of the percept.
        columns: usize,
        /// Number of rows in the configuration, 0 without percepts.
        expected_rows: usize,
        /// Number of columns in the configuration, 0 without percepts.
        expected_columns: usize,
    },
    /// The configuration has percepts, and the move brings none.
    #[error("the percept is missing; give the robot's view, or configure `Percepts::None`")]
    PerceptMissing,
}

/// Reason why an observer cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StartError {
    /// The configuration is invalid.
    #[error("the configuration is invalid; correct this field")]
    Config(#[from] DiktiometryConfigError),
    /// The view of the first place does not fit the configuration.
    #[error("the view at the start does not fit the configuration; correct one of them")]
    Start(#[from] ObservedMoveError),
}
