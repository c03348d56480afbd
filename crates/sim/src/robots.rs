//! The robots, one file each, reading like their data sheets.

mod camera_pioneer;
mod epuck;
mod laser_pioneer;

pub use camera_pioneer::{CameraPioneer, CameraPioneerConfig, CameraPioneerError};
pub use epuck::{Epuck, EpuckConfig, EpuckError};
pub use laser_pioneer::{
    ConfigError, LaserPioneer, LaserPioneerConfig, LaserPioneerFaults, MotorNoise,
};
