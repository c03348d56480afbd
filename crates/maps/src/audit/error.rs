use thiserror::Error;

/// Reason why a graph cannot be audited.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AuditError {
    /// An edge of odometry does not join a pose with the next.
    #[error(
        "edge {edge} from pose {from} to {to} is odometry, which joins a pose with the next; number the poses in the order they were \
         driven, or call the edge a closure"
    )]
    Odometry {
        /// Number of the edge, from 0.
        edge: u32,
        /// The pose at which the edge begins.
        from: u32,
        /// The pose at which the edge ends.
        to: u32,
    },
    /// The scale of the standard deviations is invalid.
    #[error("the sigma scale is {scale}; give a positive number")]
    Scale {
        /// Scale that was given.
        scale: f64,
    },
}
