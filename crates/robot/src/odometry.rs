use tolman_geom::Pose;

/// Motion of the robot in the last time step, by its wheels.
///
/// ```
/// use tolman_geom::Pose;
/// use tolman_robot::Odometry;
///
/// // A quarter circle to the left, 1 m long.
/// let rolled = Odometry { distance: 1.0, turn: core::f64::consts::FRAC_PI_2 };
/// let pose = rolled.applied_to(Pose::IDENTITY);
/// assert!((pose.position.x - pose.position.y).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Odometry {
    /// Path length rolled, m; negative is backward.
    pub distance: f64,
    /// Turn made, rad; positive is counter-clockwise.
    pub turn: f64,
}

impl Odometry {
    /// Returns the pose after this motion, from the pose before it: dead reckoning.
    ///
    /// ```
    /// use core::f64::consts::{FRAC_PI_2, PI};
    /// use tolman_geom::{Point, Pose};
    /// use tolman_robot::Odometry;
    ///
    /// // Half a circle of radius 1 m to the left, in two steps of a quarter each.
    /// let quarter = Odometry { distance: FRAC_PI_2, turn: FRAC_PI_2 };
    /// let pose = quarter.applied_to(quarter.applied_to(Pose::IDENTITY));
    /// assert!((pose.position - Point::new(0.0, 2.0)).norm() < 1e-12);
    /// assert!((pose.heading.radians() - PI).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn applied_to(self, pose: Pose) -> Pose {
        pose.displaced(self.distance, self.turn)
    }
}
