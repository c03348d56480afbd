//! The dense baseline: the trajectory of a robot and a map of points, from scans that are matched
//! to earlier ones.
//!
//! In the order data flows:
//!
//! 1. A [`ScanStep`] brings a scan and the odometry since the one before. Beams become an outline
//!    of surface points.
//! 2. The outline is matched to the last keyframes. All poses in a window about the odometry's are
//!    tried, by branch and bound on a grid of likelihoods, then Newton's steps from the best.
//! 3. After some way the scan becomes a keyframe: a pose of a
//!    [`PoseGraph`](crate::pose_graph::PoseGraph), joined to the one before with the information of
//!    the match.
//! 4. The last keyframes together are matched to old ones near by, in a window that grows with the
//!    way since the last closure. Two matches that agree become closures, and the graph is
//!    optimized.
//! 5. [`ScanMatching::finish`] searches all closures again, on the map that they made, until it
//!    finds the same ones twice.
//! 6. [`ScanMatching::overlay`] finds where the map of another day lies on this one.
//!
//! Sources: E. Olson: Real-Time Correlative Scan Matching, 2009; K. Konolige et al.: Efficient
//! Sparse Pose Adjustment for 2D Mapping, 2010 (the program Karto). [`scan_map`](crate::scan_map)
//! has a compass and corrects positions on a map that never moves. This module finds headings too,
//! and old parts of its map move when a place is seen again.

mod closures;
mod config;
mod correlate;
mod grid;
mod mapper;
mod occupancy;
mod outline;
mod overlay;
mod refine;
mod surroundings;

pub use config::{ClosureConfig, ClosureSites, ScanMatchingConfig};
pub use mapper::{ScanMatching, ScanMatchingError, ScanStep};
pub use occupancy::OccupancyGrid;
pub use overlay::MapOverlay;
