//! Poses joined by what was measured between them, made to agree as well as they can.
//!
//! Dead reckoning joins each pose to the next, and a recognized place joins two poses that lie far
//! apart on the way. [`PoseGraph::optimize`] finds the poses under which the sum of all squared
//! errors, each weighted by its information, is least. An edge that may be wrong is a
//! [`Closure`](PoseEdgeKind::Closure): the more it disagrees with the others, the less it counts.
//!
//! Source: G. Grisetti, R. Kümmerle, C. Stachniss, W. Burgard: A Tutorial on Graph-Based SLAM,
//! 2010, with the robust kernel of P. Agarwal et al.: Robust Map Optimization using Dynamic
//! Covariance Scaling, 2013. Deviation: the linear systems are solved by conjugate gradients, which
//! need no order of elimination.

mod edge;
mod error;
mod graph;
mod optimizer;
mod system;

pub use edge::{PoseEdge, PoseEdgeKind};
pub use error::PoseGraphError;
pub use graph::PoseGraph;
pub use optimizer::{Optimized, OptimizerConfig};
