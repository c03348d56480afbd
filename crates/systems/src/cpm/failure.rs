use thiserror::Error;
use tolman_geom::IntervalError;
use tolman_maps::cpm::{CpmError, LocalizeError, Sighting};
use tolman_robot::Robot;

use super::walker::WalkError;

/// Result of CPM's driving of the body `B`, or why it cannot go on.
pub type CpmResult<T, B> = Result<T, CpmFailure<<B as Robot>::Error>>;

/// Reason why CPM cannot go on with its robot.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CpmFailure<E> {
    /// The robot.
    #[error(transparent)]
    Walk(#[from] WalkError<E>),
    /// The map refuses what it met.
    #[error(transparent)]
    Map(#[from] CpmError),
    /// Dead reckoning has no number.
    #[error(transparent)]
    Reckoning(#[from] IntervalError),
    /// The maps cannot be searched for where it is.
    #[error(transparent)]
    Localize(#[from] LocalizeError),
    /// The map has no start.
    #[error("the map has no start to be put back to; mark the start of the maze")]
    NoStart,
    /// The robot stands elsewhere than where its map begins.
    #[error(
        "the robot is at {found}, which is not where its map begins; put it at the start of the maze in which the map was learned"
    )]
    NotTheStart {
        /// What it sees.
        found: Sighting,
    },
}
