//! Diktiometry: a robot walks corridors from place to place while a map of it grows.
//!
//! In the order data flows:
//!
//! 1. A [`Surveyor`] makes a [`Rover`] of any robot that turns and translates and that senses
//!    ranges, compass and wheels. Its control routines end at corners and doorways.
//! 2. An [`Odometer`] bounds the robot's displacement; an [`Eye`] makes a signature of its view.
//! 3. Each [`Arrival`] goes to the [`Observer`](tolman_maps::diktiometry::Observer), which makes
//!    the map.
//! 4. The planner chooses where to go: at random, or as the map advises.
//!
//! A [`Diktiometer`] is all of this as a [`System`](tolman_robot::System): it explores, localizes,
//! and goes to places and landmarks, also when it was put down anywhere on its map.
//!
//! Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", AAAI Fall
//! Symposium 1992.

mod approach;
mod corridor;
mod diktiometer;
mod errors;
mod eye;
mod guide;
mod landmark_spot;
mod mapped_move;
mod odometer;
mod of_sites;
mod place_middle;
mod planner;
mod route_finder;
mod routine_config;
mod rover;
mod surveyor;
#[cfg(test)]
mod tests;

pub use diktiometer::{
    Diktiometer, DiktiometerConfig, DiktiometerError, ExploreUntil, RefusedMove,
};
pub use errors::{RoutineError, SenseError};
pub use eye::{CameraEye, Eye, LaserEye, NoEye, aligned_signatures, exit_signatures};
pub use landmark_spot::LandmarkSpot;
pub use mapped_move::{MapError, MappedMove};
pub use odometer::Odometer;
pub use of_sites::DiktiometryOfSites;
pub use planner::Reason;
pub use routine_config::RoutineConfig;
pub use rover::{Arrival, Rover};
pub use surveyor::Surveyor;

use approach::{Approach, approach};
use corridor::{Around, Beside, View, compass, round_scan};
use guide::{Guide, Next, give_up};
use landmark_spot::{is_at_goal, sought};
use mapped_move::{first_place, observed};
use place_middle::{Offset, offset};
use planner::Planner;
use route_finder::RouteFinder;
use surveyor::Routine;
