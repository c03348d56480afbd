//! Defines a robot's readings and commands, simulated or real.
//!
//! A [`Robot`] carries a command for one time step and answers with what it senses. The crates
//! above use only this trait and these value types. So a brain or a layer that was tried on the
//! simulator runs on a driver without a change.
//!
//! A robot of one make has a module of its own with its measures: [`epuck`], [`pioneer_2dx`].
//!
//! Metres, radians, seconds; the robot's frame has x ahead and y to the left.
//!
//! # A mapper of your own
//!
//! `cargo run --example own_mapper`:
#![doc = "```"]
#![doc = include_str!("../examples/own_mapper.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;
#[cfg(feature = "epuck-serial")]
extern crate std;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use tolman_geom as geom;

mod body;
mod capabilities;
mod column_image;
pub mod epuck;
#[cfg(feature = "epuck-serial")]
pub mod epuck_serial;
mod fitted;
mod landmark;
mod laser_robot;
mod mapper;
mod measures;
mod odometry;
mod picture;
pub mod pioneer_2dx;
mod reckoned;
mod robot;
mod scan;
mod snapshot;
mod sounding;
mod stopping;
mod system;
mod trajectory;
mod turn_translate;
mod velocity_rover;

pub use body::Body;
pub use capabilities::{Bumps, Clock, Compass, Ranges, Rolls, Sees};
pub use column_image::{CameraSensing, ColumnImage};
pub use fitted::{Fitted, FittedError, MadeFor};
pub use landmark::{Landmark, Landmarked, SensesLandmarks};
pub use laser_robot::LaserSensing;
pub use mapper::{Guess, MapLink, MapPlace, MapView, Mapper, Position, VisitNaming};
pub use measures::{LaserMeasures, MeasuresError, RobotMeasures, StepMeasures};
pub use odometry::Odometry;
pub use picture::{Picture, PinholeCamera};
pub use reckoned::Reckoned;
pub use robot::{Robot, Standstill};
pub use scan::{Ring, Scan};
pub use snapshot::{Snapshot, TakesSnapshots};
pub use sounding::{Sounding, Soundings};
pub use stopping::Stopping;
pub use system::{Goal, Standing, System, Task};
pub use trajectory::{PoseRelation, TimedPose, Trajectory};
pub use turn_translate::TurnTranslate;
pub use velocity_rover::{BaseReport, RoverConfig, RoverError, VelocityBase, VelocityRover};
