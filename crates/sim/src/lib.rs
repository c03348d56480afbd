//! A seeded two-dimensional world for robots: walls to meet, sensors to meet them with, noise on
//! both.
//!
//! In the order data flows:
//!
//! 1. A [`World`] is what stands still: walls with their [`Material`], named [`Zone`]s and
//!    [`Door`]s. It is built from a grid maze, from free segments or from an occupancy grid, and
//!    never changes; share one between runs with an [`Arc`](std::sync::Arc).
//! 2. A [`Simulation`] puts robots into it and keeps what changes: where they are and which doors
//!    are shut. Each [`step`](Simulation::step) takes one command per robot, moves the bodies (they
//!    stop or slide, and never pass through anything) and lets every robot sense again.
//! 3. A robot is a [`Model`]: a body, a motor that makes a [`Motion`] of a command, and sensors. A
//!    [`Sensor`](sensors::Sensor) reads its [`Surroundings`]. [`robots`] holds the models and reads
//!    like their data sheets.
//! 4. [`noise`] wraps sensors and motors: every fault draws from its own channel of [`Chance`], so
//!    that adding one never shifts another.
//! 5. [`trace`] writes down what happened and replays it to the bit.
//! 6. [`Solo`] is one robot in a world of its own behind [`tolman_robot::Robot`], which is all that
//!    a brain gets to see. The [`Truth`] is kept beside it, for scoring.
//!
//! With [`tolman_robot`] this crate suffices for a robot in a world: [`geom`], [`maze`] and
//! [`rand`], which its signatures need, are re-exported.
//!
//! The feature `parry2d`, on by default, adds a reference for testing the ray casters: see
//! [`casters`].
//!
//! Metres, radians, microseconds; x is east, y is north, angles grow counter-clockwise.
//!
//! ```
//! use tolman_robot::{Robot, TurnTranslate};
//! use tolman_sim::geom::{Heading, Pose};
//! use tolman_sim::maze::{Cell, Grid, Maze};
//! use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
//! use tolman_sim::{CorridorSize, Solo, World};
//!
//! let mut maze = Maze::open(Grid::new(3, 1));
//! maze.set_goals(vec![Cell::new(2, 0)]);
//! let world = World::from_maze(&maze, &CorridorSize::thin(0.95))?;
//! let start = Pose::new(world.cell_centre(Cell::new(0, 0)), Heading::EAST);
//!
//! let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?;
//! let mut solo = Solo::new(world, robot, start, 7)?;
//! while !solo.truth().bump {
//!     solo.step(&TurnTranslate { turn: 0.0, translate: 1.0 })?;
//! }
//! let destination = solo.simulation().world().zone("destination").unwrap();
//! assert!(destination.contains(solo.truth().pose.position));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A sensor of your own
//!
//! `cargo run --example own_sensor`:
#![doc = "```"]
#![doc = include_str!("../examples/own_sensor.rs")]
#![doc = "```"]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use rand;
pub use tolman_geom as geom;
pub use tolman_maze as maze;
pub use tolman_robot as robot;

mod body;
mod chance;
mod contact;
mod door;
mod model;
mod scene;
mod simulation;
mod solo;
mod surroundings;
mod world;

pub mod casters;
pub mod noise;
pub mod robots;
pub mod sensors;
pub mod trace;

pub use body::BodyError;
pub use chance::{Chance, Channel, Draws};
pub use contact::Contact;
pub use door::{Door, DoorEvent, DoorState};
pub use model::{CommandError, Model, Motion};
pub use simulation::{DoorError, PlaceError, RobotId, Simulation, StepError, Truth};
pub use solo::Solo;
pub use surroundings::{Echo, Ray, Surroundings};
pub use world::{
    Area, Bounds, CorridorSize, Material, Occupancy, Polyline, WallSegment, World, WorldError,
    WorldFileError, Zone,
};
