use tolman_geom::Pose;
use tolman_robot::Snapshot;

/// Record of one place (section 3.2).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaceRecord {
    /// Pose by odometry, relative to where the robot was put down.
    pub odometry: Pose,
    /// Perception of the robot there.
    pub snapshot: Snapshot,
}
