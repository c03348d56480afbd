//! Measures the errors of a trajectory found from a log, by published ground truth.
//!
//! [`RelationScore`] uses relative poses that were verified by hand; [`AlignedScore`] another
//! trajectory, whose frame need not be the same.
//!
//! Source: R. Kümmerle et al.: On Measuring the Accuracy of SLAM Algorithms, 2009.

mod aligned;
mod relations;
mod spatial;

pub use aligned::AlignedScore;
pub use relations::RelationScore;
pub use spatial::{ErrorStatistics, PosePair, SpatialScore, TrajectoryAlignment};
