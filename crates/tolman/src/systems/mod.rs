//! The systems of this project, each with the robots that it can drive.

mod cpm;
mod diktiometry;
mod gngslam;
mod mslst;
mod mslst_better;

pub use cpm::CpmEntry;
pub(crate) use cpm::patterns_of_epuck;
pub use diktiometry::DiktiometryEntry;
pub use gngslam::GngSlamEntry;
pub use mslst::MslstEntry;
pub use mslst_better::MslstBetterEntry;
