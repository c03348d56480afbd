use tolman_geom::Pose;

/// What the wheels say the robot did in the last time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Odometry {
    /// Path length rolled, m; negative is backward.
    pub distance: f64,
    /// Turn made, rad; positive is counter-clockwise.
    pub turn: f64,
}

impl Odometry {
    /// Dead reckoning: the pose after this motion, from the pose before it.
    #[must_use]
    pub fn applied_to(self, pose: Pose) -> Pose {
        pose.displaced(self.distance, self.turn)
    }
}
