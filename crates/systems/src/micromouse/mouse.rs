//! Defines the interface between a mouse and the referee.

use tolman_maps::wall_map::{ObserveError, TooLarge};
use tolman_planners::moves::MoveExplorerConfigError;

/// Maximum number of columns or rows of a maze that our mice can hold.
pub const SIDE: usize = 32;

/// Reading of the three sensors of a mouse: the number of open cells up to the next wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sight {
    /// Number of open cells to the left.
    pub left: u16,
    /// Number of open cells ahead.
    pub front: u16,
    /// Number of open cells to the right.
    pub right: u16,
}

/// Reason why a mouse cannot decide.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MouseError {
    /// The maze is larger than its map.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The reading is impossible at the mouse's believed place.
    #[error("the mouse has lost its way")]
    Observe(#[from] ObserveError),
    /// The weights of the search, or the values for choosing among stops, are invalid.
    #[error(transparent)]
    Config(#[from] MoveExplorerConfigError),
    /// No way leads to a goal.
    #[error("the mouse has found that no way leads to a goal: open a wall")]
    Stuck,
}
