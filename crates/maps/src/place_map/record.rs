use tolman_geom::Pose;
use tolman_robot::Snapshot;

/// What was recorded at one place (section 3.2).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaceRecord {
    /// Where the odometry has the robot, from where it was put down.
    pub odometry: Pose,
    /// What it perceived there.
    pub snapshot: Snapshot,
}
