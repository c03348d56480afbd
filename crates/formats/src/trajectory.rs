//! Reads and writes trajectories and relations, in the formats of evaluation programs.

mod read;
mod relations;
mod tum;

pub use read::{ReadTrajectory, SpacePose, TrajectoryError};
pub use relations::ReadRelations;
pub use tum::tum;
