//! The sensors, one file each.
//!
//! To add one: write a file with a type that implements [`Sensor`], and give the model of the robot
//! that carries it a field for it.

use crate::{Chance, Surroundings};

mod bumper;
mod compass;
mod laser;
mod odometry;

pub use bumper::Bumper;
pub use compass::Compass;
pub use laser::{Laser, LaserError};
pub use odometry::WheelOdometry;

/// Something that reads a value off the surroundings of a robot.
pub trait Sensor {
    /// What it reads.
    type Reading;

    /// Takes a reading: `None` where the sensor gives nothing this time. What `reading` held before
    /// may be written over in place, so that a step need not allocate.
    fn sense(
        &mut self,
        surroundings: &Surroundings<'_>,
        chance: &Chance,
        reading: &mut Option<Self::Reading>,
    );
}
