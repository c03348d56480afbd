//! The robots, one file each, reading like their data sheets.

use crate::noise::{Faults, Values};

mod camera_pioneer;
mod epuck;
mod laser_pioneer;
mod pioneer_2dx;

pub use camera_pioneer::{
    CameraPioneer, CameraPioneerConfig, CameraPioneerDisturbances, CameraPioneerError,
};
pub use epuck::{Epuck, EpuckConfig, EpuckDisturbances, EpuckError};
pub use laser_pioneer::{
    LaserPioneer, LaserPioneerConfig, LaserPioneerDisturbances, LaserPioneerFaults, MotorNoise,
    RobotConfigError, StuckBeam,
};
pub use pioneer_2dx::{
    Pioneer2dx, Pioneer2dxConfig, Pioneer2dxDisturbances, Pioneer2dxError, Pioneer2dxFaults,
    WheelScale,
};

/// Returns what a trace calls the disturbances of one value: the name of the value, and how each
/// prints itself.
fn names<V: Values>(value: &str, faults: &Faults<V>) -> impl Iterator<Item = String> {
    faults
        .disturbances()
        .iter()
        .map(move |disturbance| format!("{value}: {disturbance:?}"))
}
