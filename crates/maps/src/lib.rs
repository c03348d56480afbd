//! Maps that a robot learns of its surroundings, one module per kind of map.
//!
//! - [`wall_map`]: the walls of a grid maze: unknown, open or standing. Fixed size, no allocation.
//! - [`wall_belief`]: the same walls for a mouse whose sensors and wheels err, and where on them it
//!   is.
//! - [`bump_map`]: places and ways from actions and bumps alone, without odometry.
//! - [`cpm`]: the path fragments between junctions, as sequences of common patterns, and how
//!   junctions join them.
//! - [`diktiometry`]: places, actions between them and bounds on where they lie, as an observer of
//!   any robot's moves.
//! - [`place_map`]: places as prototypes of what was seen, heard and rolled there.
//! - [`place_graph`]: places and where they lie, learned while they correct the robot's pose.
//! - [`pose_graph`]: poses joined by what was measured between them, made to agree.
//! - [`audit`]: which closures of a pose graph are right, as far as its odometry and its other
//!   closures tell.
//! - [`scan_map`]: places and walls learned from scans, each place once, and where on them a robot
//!   may stand.
//! - [`scan_matching`]: the robot's way by scans matched to those before, and by places seen again.
//! - [`mslst_graph`]: the sensory states that MSLST met and the actions that led from one to the
//!   next.
//!
//! A map takes in what is observed and answers what is known. Planners decide what to do next. They
//! depend on no map type, only on a trait of their own crate or of the vocabulary below them, such
//! as [`tolman_maze::Walls`].
//!
//! # A mapper on your own robot
//!
//! `cargo run --example own_robot`:
#![doc = "```"]
#![doc = include_str!("../examples/own_robot.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
#[cfg(feature = "alloc")]
pub use rand;
#[cfg(feature = "alloc")]
pub use tolman_geom as geom;
pub use tolman_maze as maze;
pub use tolman_planners as planners;
#[cfg(feature = "alloc")]
pub use tolman_quantizers as quantizers;
#[cfg(feature = "alloc")]
pub use tolman_robot as robot;

#[cfg(feature = "alloc")]
pub mod audit;
#[cfg(feature = "alloc")]
pub mod bump_map;
#[cfg(feature = "alloc")]
pub mod cpm;
#[cfg(feature = "alloc")]
pub mod diktiometry;
#[cfg(feature = "alloc")]
pub mod mslst_graph;
#[cfg(feature = "alloc")]
pub mod place_graph;
#[cfg(feature = "alloc")]
pub mod place_map;
#[cfg(feature = "alloc")]
pub mod pose_graph;
#[cfg(feature = "alloc")]
pub mod scan_map;
#[cfg(feature = "alloc")]
pub mod scan_matching;
#[cfg(feature = "alloc")]
mod tangent;
#[cfg(feature = "alloc")]
pub mod wall_belief;
pub mod wall_map;
