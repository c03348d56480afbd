//! Layered corrections: how "go north" becomes turns and steps that stay clear of the walls.
//!
//! This is the *layered corrections architecture* of MSLST (Tingle, Ball, Augat: "Maze Solving by
//! Learning State Topologies"). A brain names a compass direction; the [`Stack`] turns it into
//! motor commands, one time step at a time. The top layer proposes a command. Every layer below has
//! a [`correct`](Layer::correct) method. It takes the proposal of the layer above and may add to
//! it, override it, or end the action. What subsumption can only replace, a correction can add to.
//!
//! In the order the data flows:
//!
//! 1. [`CorridorDetector`]: do the sums of opposite beams look like a corridor?
//! 2. [`Move`]: turn to the heading of the action, then translate for two steps.
//! 3. [`Orient`]: in a corridor, face along it; an action that turns away from it fails.
//! 4. [`Center`]: in a corridor, steer to its middle.
//! 5. [`Avoid`]: stop before a wall, and edge away from one beside.
//! 6. [`Settle`], which is ours: make a turn to and fro die out, so that every action ends.
//!
//! Who has no compass, or one that errs, has a [`HeadingFilter`], which is ours: it tells the
//! heading from the wheels and the directions of the walls.
//!
//! The robot of another paper, CPM's e-puck, has its own layers in [`epuck`]. Those of a robot that
//! drives until something is near are in [`wander`].
//!
//! A [`Drive`] carries out whole actions by a stack, with any robot that senses ranges and its
//! heading. An action that its layers do not end ends as [`Outcome::TimedOut`].
//!
//! Each layer stands alone behind [`Layer`]; a stack is any list of them. Lengths are metres; the
//! paper's own figures are in *robot units* (1 unit = 1 robot diameter), which [`Stack::paper`]
//! takes and converts once.
//!
//! With the feature `serde` layers and configurations can be saved and loaded. What is read is
//! checked: a number without sense or an unknown field is refused. Of a layer its gains are saved,
//! not the action it is in.
//!
//! # On your own robot
//!
//! The gains are fractions of a full motor command, so the drive decides what they do. One full
//! turn command should turn less than 108° in a time step; the calibrated robot turns 91°. Move's
//! 0.0105 and Orient's 0.008 a degree add up, and at twice the error a swing no longer dies out.
//! Beams wider than 5° can swing earlier. [`Settle`] ends these swings, at the price of some 25
//! time steps, as long as a full command turns less than half a circle. Two steps at a translation
//! of 0.25 should cover about one robot diameter.
//!
//! ```
//! use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
//! use tolman_control::{Outcome, Stack, View};
//! use tolman_geom::Heading;
//! use tolman_maze::Direction;
//! use tolman_robot::{Ring, Scan};
//!
//! let ring = Ring::full(72, 1.25);
//! let mut stack = Stack::paper(ring, 0.5, 0.95)?;
//! let mut rng = ChaCha8Rng::seed_from_u64(1);
//! // A robot in the open that looks east and is told to go north.
//! let scan = Scan::clear(ring);
//! let mut heading = Heading::EAST;
//! stack.begin(Direction::North);
//! let outcome = loop {
//!     let step = stack.correct(View { scan: &scan, heading }, &mut rng);
//!     // Here the motors would run for one time step; this robot turns as it is told.
//!     heading = heading.turned(step.command.turn * 91_f64.to_radians());
//!     if let Some(outcome) = step.ends {
//!         break outcome;
//!     }
//! };
//! assert_eq!(outcome, Outcome::Completed);
//! assert!(heading.turn_to(Heading::NORTH).abs() < 4_f64.to_radians());
//! # Ok::<(), tolman_control::RingError>(())
//! ```
//!
//! # A layer of your own
//!
//! `cargo run --example own_layer`:
#![doc = "```"]
#![doc = include_str!("../examples/own_layer.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use rand;
pub use tolman_geom as geom;
pub use tolman_maze as maze;
pub use tolman_robot as robot;

mod avoid;
mod center;
mod corridor;
mod drive;
pub mod epuck;
mod heading;
mod layer;
mod move_layer;
mod orient;
mod outcome;
#[cfg(feature = "serde")]
mod read;
mod settle;
mod stack;
mod straighten;
mod stuck_beams;
pub mod wander;

pub use avoid::Avoid;
pub use center::Center;
pub use corridor::{Corridor, CorridorDetector, RingError};
pub use drive::{Drive, Driven};
pub use heading::{HeadingFilter, HeadingReadings};
pub use layer::{Layer, Proposal, Situation, View};
pub use move_layer::{Move, heading_of, unit_of};
pub use orient::Orient;
pub use outcome::Outcome;
pub use settle::Settle;
pub use stack::Stack;
pub use straighten::straightened;
pub use stuck_beams::StuckBeams;
