//! Reads and writes trajectories and relations, in the formats of evaluation programs.

mod relations;
mod tum;

pub use relations::ReadRelations;
pub use tum::{ReadTrajectory, tum};
