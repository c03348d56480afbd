//! Models of robots, one file each, which read like data sheets.

use crate::noise::{Fault, Faults, Gaussian, Values};

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

/// Returns the names of the disturbances of one value in a trace: `value` and each disturbance's
/// `Debug` text.
fn names<V: Values>(value: &str, faults: &Faults<V>) -> impl Iterator<Item = String> {
    faults
        .disturbances()
        .iter()
        .map(move |disturbance| format!("{value}: {disturbance:?}"))
}

/// Returns the faults of a value with the noise as the first, nearest to the truth.
fn noisy<V: Values>(value: &str, noise: Gaussian, faults: &[Fault]) -> Faults<V> {
    let noise = [Fault::Gaussian(noise)].into_iter();
    Faults::new(value, noise.chain(faults.iter().copied()))
}
