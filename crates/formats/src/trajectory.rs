//! Reads and writes trajectories and relations, in the form of programs that judge them.

mod relations;
mod tum;

pub use relations::ReadRelations;
pub use tum::{ReadTrajectory, tum};
