//! The systems: one paper a folder, written to be read beside it.
//!
//! Each system drives any robot that senses what it needs, simulated or real, through the traits of
//! `tolman-robot`. Nothing here knows a simulator, a terminal or the truth.
//!
//! MSLST and its [`baselines`] share a body. A [`Brain`] observes one [`TimeStep`] at a time and
//! chooses compass directions. An [`Actor`] lets it drive a robot through the layers of
//! `tolman-control`.
//!
//! With `tolman-robot` this crate suffices for a system on a robot: it re-exports all that its
//! signatures need of other crates.
//!
//! ```
//! use tolman_systems::control::{RingError, Stack};
//! use tolman_systems::cpm::{Cpm, CpmConfig, RingMeasures};
//! use tolman_systems::maps::cpm::CpmError;
//! use tolman_systems::robot::Ring;
//!
//! fn cpm(measures: &RingMeasures) -> Result<Cpm, CpmError> {
//!     Cpm::unlearned(measures.walker_config(), CpmConfig::robust(), 1)
//! }
//!
//! fn layers(ring: Ring) -> Result<Stack, RingError> {
//!     Stack::paper(ring, 0.3, 0.57)
//! }
//! ```
//!
//! # A mouse and its proof
//!
//! `cargo run --example proven_run`:
#![doc = "```"]
#![doc = include_str!("../examples/proven_run.rs")]
#![doc = "```"]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use rand;
pub use rand_chacha;
pub use tolman_control as control;
pub use tolman_geom as geom;
pub use tolman_maps as maps;
pub use tolman_maze as maze;
pub use tolman_planners as planners;
pub use tolman_quantizers as quantizers;
pub use tolman_robot as robot;

mod actor;
pub mod baselines;
mod brain;
pub mod cpm;
pub mod diktiometry;
pub mod gngslam;
mod lifts;
mod map_header;
pub mod micromouse;
pub mod mslst;
mod on_robot;
mod own_heading;
pub mod places;
mod stream;
mod time_step;

pub use actor::{Actor, ActorError};
pub use brain::Brain;
pub use map_header::{FileError, MapFiles, Origin, origin_of};
pub use on_robot::{AnyOnRobot, ForRobotError, LaserRobot, OnRobot};
pub use own_heading::{Oriented, OwnHeading};
pub use stream::stream;
pub use time_step::{Doing, OfStep, RolledStep, TimeStep};
