//! The robots, one file each, reading like their data sheets.

mod epuck;
mod laser_pioneer;

pub use epuck::{Epuck, EpuckConfig, EpuckError};
pub use laser_pioneer::{
    ConfigError, LaserPioneer, LaserPioneerConfig, LaserPioneerFaults, MotorNoise,
};
