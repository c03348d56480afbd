use alloc::vec::Vec;

use tolman_robot::epuck::PROXIMITY_SENSORS;

/// Raw values of all proximity sensors while the robot turns once round, counter-clockwise, in
/// place (section 4.1).
///
/// Sample *k* of *n* was taken when the robot had turned by *k* · 360°/*n*, so that the first looks
/// as the robot does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sweep {
    /// The samples, in order: the values of all sensors, or none where they gave nothing.
    pub samples: Vec<Option<[f64; PROXIMITY_SENSORS]>>,
}
