//! A mouse for the simulator [mms](https://github.com/mackorone/mms): it explores, drives home, and
//! makes the run that scores least.
//!
//! [`play`] speaks the protocol of mms over any two streams: one command per line out, one reply
//! per line in. The mouse's [`LatticePoint`] lies on a lattice of half-steps, since mms scores
//! diagonals.

mod error;
mod lattice;
mod link;
mod mouse;
mod plan;
mod roads;

pub use error::PlayError;
pub use lattice::{Gate, LatticeHeading, LatticePoint};
pub use mouse::{Played, play};
pub use plan::best_score;
