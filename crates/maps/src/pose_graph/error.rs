use thiserror::Error;

/// Reason why an edge cannot be added to a graph of poses.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PoseGraphError {
    /// There is no such pose.
    #[error(
        "the edge from {from} to {to} names a pose that does not exist: add it first; the graph has {poses} poses"
    )]
    NoPose {
        /// The pose at which the edge begins.
        from: u32,
        /// The pose at which the edge ends.
        to: u32,
        /// The number of poses.
        poses: usize,
    },
    /// The edge joins a pose with itself.
    #[error("an edge joins pose {pose} with itself: leave it out")]
    Loop {
        /// Id of the pose.
        pose: u32,
    },
    /// A number of the measurement or of the information is not finite.
    #[error("the edge from {from} to {to} has a number that is not finite; give finite numbers")]
    NotFinite {
        /// The pose at which the edge begins.
        from: u32,
        /// The pose at which the edge ends.
        to: u32,
    },
    /// The information matrix is invalid: it is negative in some direction.
    #[error(
        "the information of the edge from {from} to {to} is not that of a measurement: give a symmetric matrix that is positive \
         definite"
    )]
    Information {
        /// The pose at which the edge begins.
        from: u32,
        /// The pose at which the edge ends.
        to: u32,
    },
}
