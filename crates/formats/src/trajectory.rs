//! Ways in time and what is known of them, as programs that judge them read and write them.

mod relations;
mod tum;

pub use relations::ReadRelations;
pub use tum::{ReadTrajectory, tum};
