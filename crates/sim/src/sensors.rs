//! Models of sensors, one file each.
//!
//! To add one, write a file with a type that implements [`Sensor`]. Give the model of the robot
//! that carries it a field, sensed in [`Model::sense`](crate::Model::sense). [`Surroundings`]
//! answers what a sensor can ask; [`Faults`](crate::noise::Faults) make its reading noisy.
//!
//! ```
//! use tolman_geom::Point;
//! use tolman_sim::sensors::Sensor;
//! use tolman_sim::{Chance, Surroundings};
//!
//! /// Hears a beacon: the louder the nearer.
//! struct Microphone {
//!     beacon: Point,
//! }
//!
//! impl Sensor for Microphone {
//!     type Reading = f64;
//!
//!     fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<f64>) {
//!         let distance = (self.beacon - around.truth.pose.position).norm();
//!         *reading = Some(1.0 / (1.0 + distance * distance));
//!     }
//! }
//! ```

use crate::{Chance, Surroundings};

mod column_camera;
mod cone;
mod infrared;
mod laser;
mod picture_camera;
mod sonars;

pub use column_camera::{CameraError, ColumnCamera};
pub use infrared::{Infrared, ResponseCurve, ResponseError, ResponsePoint};
pub use laser::{Laser, LaserError};
pub use picture_camera::{Backdrop, Light, LightDrift, PictureCamera, PictureCameraConfig};
pub use sonars::{CrossTalk, Misses, SonarConfig, Sonars};

/// A sensor, which reads a value from the surroundings of a robot.
pub trait Sensor {
    /// Type of the sensor's readings.
    type Reading;

    /// Takes a reading. Returns `None` if the sensor gives nothing this time. The old contents of
    /// `reading` may be overwritten in place, so that a step need not allocate.
    fn sense(
        &mut self,
        surroundings: &Surroundings<'_>,
        chance: &Chance,
        reading: &mut Option<Self::Reading>,
    );
}
