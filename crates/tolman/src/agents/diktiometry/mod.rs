//! Diktiometry: a robot walks an office from place to place while a map of it grows beside.
//!
//! An [`Office`] is the world, with its true places. A [`Surveyor`] is the robot: control routines that end at places, with the
//! odometry and the picture of each move. A [`Survey`] is one run: a [`Planner`] chooses where to go, an
//! [`Observer`](tolman_maps::diktiometry::Observer) makes the map, [`ErrorSummary`] and [`MapScore`] say how well.
//!
//! Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", AAAI Fall Symposium 1992, *Results*.

mod errors;
mod office;
mod planner;
mod score;
mod survey;
mod surveyor;

pub use errors::{ErrorSummary, MoveError, NEAR, TAIL, WINDOW};
pub use office::{
    CORRIDOR_WIDTH, DOORWAY_WIDTH, Office, OfficeConfig, OfficeError, PITCH, PlaceKind, TruePlace,
    WALL_THICKNESS, blocks,
};
pub use planner::{Decision, Planner, Reason};
pub use score::{Isomorphism, MapScore, Visit, score};
pub use survey::{Drawn, RunError, Survey, SurveyConfig, Surveyed, mapper};
pub use surveyor::{Arrival, RoutineOutcome, SurveyError, Surveyor, SurveyorConfig};
