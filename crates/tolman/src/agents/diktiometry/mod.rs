//! Diktiometry: a robot walks an office from place to place while a map of it grows beside.
//!
//! An [`Office`] is the world, with its true places. A [`Surveyor`] is the robot: control routines that end at places, with the
//! odometry and the picture of each move.
//!
//! Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", AAAI Fall Symposium 1992, *Results*.

mod office;
mod surveyor;

pub use office::{
    CORRIDOR_WIDTH, DOORWAY_WIDTH, Office, OfficeConfig, OfficeError, PITCH, PlaceKind, TruePlace,
    WALL_THICKNESS,
};
pub use surveyor::{Arrival, RoutineOutcome, SurveyError, Surveyor, SurveyorConfig};
