use crate::mslst::ROBOT_UNIT;

/// What the better system reckons with.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BetterConfig {
    /// Diameter of the robot, m.
    pub diameter: f64,
    /// Standard deviation of what the wheels rolled in a time step, as a share of it.
    pub odometry_sd: f64,
    /// Standard deviation of how far a wall pushed the robot aside in a time step in which it touched one, m.
    pub slide_sd: f64,
    /// How far an action leads, m.
    pub action_way: f64,
    /// Standard deviation of that, as a share of it.
    pub action_sd: f64,
    /// Ranges below which the layers refuse to go on, m.
    pub buffer: f64,
}

impl BetterConfig {
    /// Returns the values for the paper's robot.
    #[must_use]
    pub const fn pioneer() -> Self {
        Self {
            diameter: ROBOT_UNIT,
            odometry_sd: 0.05,
            slide_sd: 0.1,
            action_way: ROBOT_UNIT,
            action_sd: 0.2,
            buffer: 0.9 * ROBOT_UNIT,
        }
    }
}
