use core::f64::consts::TAU;

use thiserror::Error;
use tolman_geom::{Heading, Vector};
use tolman_robot::ColumnImage;

use super::Sensor;
use crate::{Chance, Motion, Ray, Surroundings};

/// A camera in the middle of the robot that looks all round: the mean colour of each column of its
/// image.
///
/// A column sees the colours of walls, shut doors and other robots; where nothing is in reach it is
/// black. Light comes from everywhere, so that a colour is the same from far and near. No picture
/// is taken in motion, since it would be blurred.
#[derive(Clone, Debug)]
pub struct ColumnCamera {
    columns: u32,
    reach: f64,
}

/// Number of rays in one column, side by side: a column that two walls share mixes their colours.
const RAYS: usize = 5;

impl ColumnCamera {
    /// Returns a camera with `columns` columns that sees as far as `reach`, m.
    ///
    /// # Errors
    /// If it has no columns or too many, or no reach.
    pub fn new(columns: u32, reach: f64) -> Result<Self, CameraError> {
        if columns == 0 || columns > 100_000 {
            return Err(CameraError::Columns { columns });
        }
        if !(reach.is_finite() && reach > 0.0) {
            return Err(CameraError::Reach { reach });
        }
        Ok(Self { columns, reach })
    }

    /// Returns the mean red, green and blue of one column.
    fn column(&self, around: &Surroundings<'_>, index: u32) -> [f64; 3] {
        let width = TAU / f64::from(self.columns);
        let rays = core::array::from_fn::<Ray, RAYS, _>(|ray| {
            let within = (ray as f64 + 0.5) / RAYS as f64 - 0.5;
            let bearing = (f64::from(index) + within) * width;
            let heading = Heading::from_radians(around.truth.pose.heading.radians() + bearing);
            let (sin, cos) = libm::sincos(heading.radians());
            Ray {
                origin: around.truth.pose.position,
                direction: Vector::new(cos, sin),
            }
        });
        let mut sum = [0.0; 3];
        for echo in around.echoes(&rays, self.reach) {
            if echo.range < self.reach {
                for (sum, part) in sum.iter_mut().zip(echo.material.colour) {
                    *sum += f64::from(part) / 255.0;
                }
            }
        }
        sum.map(|sum| sum / RAYS as f64)
    }
}

impl Sensor for ColumnCamera {
    type Reading = ColumnImage;

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<ColumnImage>) {
        if around.truth.motion != Motion::default() {
            *reading = None;
            return;
        }
        let image = reading.get_or_insert_with(|| ColumnImage::black(self.columns));
        // A disturbance may have left an image of another camera.
        image.columns.resize(self.columns as usize, [0.0; 3]);
        for (index, column) in (0..self.columns).zip(&mut image.columns) {
            *column = self.column(around, index);
        }
    }
}

/// Reason why a camera cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CameraError {
    /// The number of columns is 0 or too large.
    #[error("the camera has {columns} columns; give 1 to 100,000")]
    Columns {
        /// Number of columns.
        columns: u32,
    },
    /// The camera's reach is not positive.
    #[error("the camera's reach is {reach} m; give a positive number of metres")]
    Reach {
        /// The offending reach, m.
        reach: f64,
    },
}
