use tolman_geom::Pose;
use tolman_robot::Snapshot;

/// Record of one place (section 3.2).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaceRecord {
    /// Pose by odometry, relative to the pose where the robot was put down.
    pub odometry: Pose,
    /// Snapshot at the place.
    pub snapshot: Snapshot,
}
