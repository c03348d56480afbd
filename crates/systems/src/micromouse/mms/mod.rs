//! A mouse for the simulator [mms](https://github.com/mackorone/mms): it explores, drives home, and
//! makes the run that scores least.
//!
//! [`play`] speaks the protocol of mms over any two streams: one command per line out, one reply
//! per line in. The mouse moves on a [lattice](tolman_planners::lattice) of half-steps, since mms
//! scores diagonals.

mod error;
mod link;
mod mouse;
mod plan;
mod roads;

pub use error::PlayError;
pub use mouse::{Played, play};
pub use plan::best_score;
