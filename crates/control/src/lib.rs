//! Layered corrections: how "go north" becomes turns and steps that stay clear of the walls.
//!
//! This is the *layered corrections architecture* of MSLST (Tingle, Ball, Augat: "Maze Solving by
//! Learning State Topologies"). A brain names a compass direction; the [`Stack`] turns it into motor
//! commands, one time step at a time. The top layer proposes, and every layer below has a
//! [`correct`](Layer::correct) method that takes the proposal of the layer above and may add to it,
//! override it, or end the action. What subsumption can only replace, a correction can add to.
//!
//! In the order the data flows:
//!
//! 1. [`CorridorDetector`]: do the sums of opposite beams look like a corridor?
//! 2. [`Move`]: turn to the heading of the action, then translate for two steps.
//! 3. [`Orient`]: in a corridor, face along it; an action that turns away from it fails.
//! 4. [`Center`]: in a corridor, steer to its middle.
//! 5. [`Avoid`]: stop before a wall, and edge away from one beside.
//!
//! Each layer stands alone behind [`Layer`]; a stack is any list of them. Lengths are metres; the
//! paper's own figures are in *robot units* (1 unit = 1 robot diameter), which every `paper`
//! constructor takes and converts once.
//!
//! ```
//! use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
//! use tolman_control::{Stack, View};
//! use tolman_geom::Heading;
//! use tolman_maze::Direction;
//! use tolman_robot::{Ring, Scan};
//!
//! let ring = Ring::full(72, 1.25);
//! let mut stack = Stack::paper(ring, 0.5, 0.95)?;
//! stack.begin(Direction::North);
//! // Nothing in sight, looking east: the first thing to do is turn left.
//! let scan = Scan::clear(ring);
//! let view = View { scan: &scan, heading: Heading::EAST };
//! let step = stack.correct(view, &mut ChaCha8Rng::seed_from_u64(1));
//! assert!(step.command.turn > 0.0 && step.command.translate == 0.0);
//! # Ok::<(), tolman_control::RingError>(())
//! ```
#![no_std]

extern crate alloc;

mod avoid;
mod center;
mod corridor;
mod layer;
mod move_layer;
mod orient;
mod outcome;
mod stack;

pub use avoid::Avoid;
pub use center::Center;
pub use corridor::{Corridor, CorridorDetector, RingError};
pub use layer::{Layer, Proposal, Situation, View};
pub use move_layer::{Move, heading_of};
pub use orient::Orient;
pub use outcome::Outcome;
pub use stack::Stack;
