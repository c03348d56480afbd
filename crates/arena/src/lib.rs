//! Worlds made ready for robots, and the loops that run systems in them.
//!
//! In the order data flows:
//!
//! - A [`course`] is a maze, or a world of free walls, made ready for runs. The [`pioneer`] is the
//!   robot that runs in it.
//! - An [`episode`] is one run of a [`Mind`] of the [`cast`]: a brain of `tolman-systems`, or an
//!   [`oracle`] that knows the truth.
//! - [`run`] is the loop that lets any system drive any robot; [`mslst`] lets MSLST learn.
//! - The [`registry`] lists systems, robots and families by name; a [`contest`](contest::Contest)
//!   sends any of them into any drawing.
//!
//! [`micromouse`] is a paper's mouse and its referee; in the [`competition`] a micromouse explores
//! a maze for its speed run. [`gngslam`] has the arenas and the data of the place map.
//! [`bump_walk`] is a robot that only feels walls, and the judge of its map. [`log_score`] judges
//! ways that were found from logs. [`drawing`] draws maps over worlds.
//! [`mms`] is the protocol of the simulator of that name;
//! [`foreign`] runs foreign programs under supervision.
//!
//! # Who learns a maze
//!
//! `cargo run --example who_learns`:
#![doc = "```"]
#![doc = include_str!("../examples/who_learns.rs")]
#![doc = "```"]

extern crate alloc;

/// Any error, for readers and callers that only report it.
pub type BoxError = Box<dyn core::error::Error + Send + Sync>;

pub mod apparatus;
pub mod bump_walk;
pub mod cast;
pub mod competition;
pub mod contest;
pub mod course;
pub mod cpm;
pub mod diktiometry;
pub mod drawing;
pub mod episode;
mod episode_error;
pub mod family;
pub mod foreign;
pub mod free_family;
pub mod gngslam;
mod lingerer;
pub mod log_score;
pub mod micromouse;
mod mind;
pub mod mms;
pub mod mslst;
mod named_map;
pub mod oracle;
mod outing;
pub mod pioneer;
pub mod registry;
pub mod run;
mod simulated;
mod taut_way;

pub use mind::{AnyBrain, AnyRollingBrain, Mind};
pub use outing::{Depicted, Founding, HasSimulated, Outing, RobotFacts, Sent};
pub use simulated::{Simulated, trace_of};
pub use taut_way::{is_clear, taut_way};
