//! Diktiometry: a robot walks an office from place to place while a map of it grows beside.
//!
//! An [`Office`] is the world, with its true places. A [`Surveyor`] is the robot: control routines that end at places, with the
//! odometry and the look of each move. [`Mapped`] is what lies between any such [`Rover`] and the
//! [`Observer`](tolman_maps::diktiometry::Observer) that makes the map. A [`Survey`] is one run: a [`Planner`] chooses where to go, [`ErrorSummary`] and [`MapScore`] say how well.
//! An [`EpuckSurvey`] is the same on CPM's e-puck in its mazes.
//!
//! Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", AAAI Fall Symposium 1992, *Results*.

mod epuck;
mod errors;
mod memory;
mod office;
mod planner;
mod rover;
mod score;
mod survey;
mod survey_file;
mod surveyor;

pub use epuck::{EpuckRoverError, EpuckSurvey, EpuckSurveyConfig, EpuckSurveyError, survey_maze};
pub use errors::{ErrorSummary, MoveError, NEAR, TAIL, WINDOW};
pub use office::{Office, OfficeConfig, OfficeError, PlaceKind, TruePlace, blocks};
pub use planner::{Decision, Planner, Reason};
pub use rover::{Arrival, MapError, Mapped, Odometer, RoutineOutcome, Rover};
pub use score::{Isomorphism, MapScore, Visit, score};
pub use survey::{Drawn, Past, PlanTrial, RunError, Survey, SurveyConfig, Surveyed, mapper};
pub use survey_file::{SurveyFile, SurveyFileError};
pub use surveyor::{Sight, SurveyError, Surveyor, SurveyorConfig};
