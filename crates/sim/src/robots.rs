//! The robots, one file each, reading like their data sheets.

mod laser_pioneer;

pub use laser_pioneer::{
    ConfigError, LaserPioneer, LaserPioneerConfig, LaserPioneerFaults, MotorNoise,
};
