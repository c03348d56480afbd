//! The diktiometry's worlds, runs and scores.
//!
//! An [`Office`] is a world with its true places, an [`OfficeRobot`] a simulated Pioneer in it. A
//! [`Survey`] is one run of the [system](tolman_systems::diktiometry) there, with the truth beside;
//! [`ErrorSummary`] and [`MapScore`] say how well it went. A [`SurveyFile`] keeps a map and goes on
//! with it. An [`EpuckSurvey`] is a run on CPM's e-puck in its mazes.
//!
//! Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", AAAI Fall
//! Symposium 1992, *Results*.

mod epuck;
mod errors;
mod memory;
mod office;
mod office_robot;
mod score;
mod survey;
mod survey_file;
mod surveyor_config;

pub use epuck::{EpuckRoverError, EpuckSurvey, EpuckSurveyConfig, survey_maze};
pub use errors::{ErrorSummary, MoveError, NEAR, TAIL, WINDOW};
pub use office::{Office, OfficeConfig, TruePlace, blocks};
pub use office_robot::{OfficeRobot, office_robot};
pub use score::{MapScore, Visit, score};
pub use survey::{PlanTrial, Survey, SurveyConfig, mapper};
pub use survey_file::{SurveyFile, Surveyed};
pub use surveyor_config::{PlaceCue, SurveyorConfig};

use memory::Memory;
use office::{Places, leads, least_distance, no_way};
pub(crate) use score::share;
