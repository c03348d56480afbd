use tolman_geom::{Heading, Point, Pose};

use crate::LaserSensing;

/// One reading of a range sensor, wherever it sits and however wide it hears: a sonar's cone or a
/// laser's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sounding {
    /// Position and direction of the sensor, in the robot's frame.
    pub mount: Pose,
    /// Half-width of the sensor's cone, rad; 0 for a beam.
    pub half_width: f64,
    /// Distance of the nearest thing within the sensor's cone, m; `max_range` if the sensor met
    /// nothing.
    pub range: f64,
    /// Maximum reading, m.
    pub max_range: f64,
}

/// Senses ranges by sensors anywhere on its body.
pub trait Soundings {
    /// Returns the readings of this time step; none for a drop-out.
    fn soundings(&self) -> impl Iterator<Item = Sounding> + '_;
}

/// The beams of the laser, from the middle of the robot.
impl<S: AsRef<LaserSensing>> Soundings for S {
    fn soundings(&self) -> impl Iterator<Item = Sounding> + '_ {
        let scan = self.as_ref().scan.iter();
        scan.flat_map(|scan| {
            (0..).zip(&scan.ranges).map(|(beam, range)| Sounding {
                mount: Pose::new(
                    Point::origin(),
                    Heading::from_radians(scan.ring.bearing(beam)),
                ),
                half_width: 0.0,
                range: *range,
                max_range: scan.ring.max_range,
            })
        })
    }
}
