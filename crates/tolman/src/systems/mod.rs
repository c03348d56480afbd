//! The systems of this project, each with the robots that it drives here.

mod cpm;
mod diktiometry;
mod mslst;

pub use cpm::Cpm;
pub(crate) use cpm::patterns_of_epuck;
pub use diktiometry::Diktiometry;
pub use mslst::Mslst;
