use core::error::Error;

use tolman_geom::PointBox;
use tolman_maps::diktiometry::{MoveOutcome, Signature};
use tolman_maze::Direction;
use tolman_robot::Landmark;

/// A robot whose control routines end at distinctive places.
///
/// A [`Surveyor`](super::Surveyor) makes one of any robot that turns and translates between walls.
/// For any other robot, implement this trait. An [`Odometer`](super::Odometer) turns odometry and
/// compass into a box.
pub trait Rover {
    /// Reason a routine cannot be carried out.
    type Error: Error + Send + Sync + 'static;

    /// Returns the ways and the view at the robot's place, without moving.
    ///
    /// # Errors
    /// If its sensors give nothing.
    fn look(&mut self) -> Result<Arrival, Self::Error>;

    /// Goes in `direction` to the next place and returns what it finds. After an error it goes on
    /// with the same routine, and the arrival tells of the whole way. In the opposite direction it
    /// then turns back, if [`left_behind`](Self::left_behind) tells how far.
    ///
    /// # Errors
    /// If the routine neither ends at a place nor is blocked.
    fn go(&mut self, direction: Direction) -> Result<Arrival, Self::Error>;

    /// Returns the distance to the place that the robot left, m, if it broke off and can turn back
    /// on its way. The default never turns back.
    fn left_behind(&self) -> Option<f64> {
        None
    }

    /// Returns the landmark that the robot senses. The default senses none.
    fn landmark(&self) -> Option<Landmark> {
        None
    }

    /// Returns the landmarks that the robot sensed in time steps of this rover, each once. The
    /// default senses none.
    fn passed(&self) -> &[Landmark] {
        &[]
    }
}

/// Result of a control routine.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Whether the robot came to the next place or there was no way.
    pub outcome: MoveOutcome,
    /// Displacement of the robot, east and north, m. The true one lies inside.
    pub moved: PointBox,
    /// View of the place, turned by the compass: column 0 looks east, the others follow
    /// counter-clockwise. `None` if the robot does not look.
    pub look: Option<Signature>,
    /// Ways that lead on, by [`Direction::index`].
    pub exits: [bool; 4],
}
