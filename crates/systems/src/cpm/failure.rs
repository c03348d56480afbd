use thiserror::Error;
use tolman_geom::IntervalError;
use tolman_maps::cpm::{CpmError, LocalizeError};
use tolman_robot::Robot;

use super::walker::WalkError;

/// Result of driving the body `B`, or the reason why CPM cannot continue.
pub type CpmResult<T, B> = Result<T, CpmFailure<<B as Robot>::Error>>;

/// Reason why CPM cannot continue with its robot.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CpmFailure<E> {
    /// The robot failed.
    #[error(transparent)]
    Walk(#[from] WalkError<E>),
    /// The map refuses an observation.
    #[error(transparent)]
    Map(#[from] CpmError),
    /// Dead reckoning is not a number.
    #[error(transparent)]
    Reckoning(#[from] IntervalError),
    /// The robot's place cannot be searched on the maps.
    #[error(transparent)]
    Localize(#[from] LocalizeError),
    /// The map has no start.
    #[error("the map has no start to be put back to; mark the start of the maze")]
    NoStart,
}
