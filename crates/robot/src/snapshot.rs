use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Pose};

use crate::{LaserSensing, Picture, Sounding};

/// What a robot perceives from where it stands, whatever its sensors are.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot {
    /// What its range sensors read.
    pub soundings: Vec<Sounding>,
    /// What its camera sees; `None` of a robot without one.
    pub picture: Option<Picture>,
}

/// Can take a snapshot: senses ranges, a picture, or both.
pub trait TakesSnapshots {
    /// Returns what is perceived in this time step; `None` while there is nothing whole to be had, such as a picture
    /// while the robot moves.
    fn snapshot(&self) -> Option<Snapshot>;
}

/// The beams of the laser, from the middle of the robot.
impl<S: AsRef<LaserSensing>> TakesSnapshots for S {
    fn snapshot(&self) -> Option<Snapshot> {
        let scan = self.as_ref().scan.as_ref()?;
        let beams = (0..).zip(&scan.ranges);
        let sounding = |(beam, range): (u32, &f64)| Sounding {
            mount: Pose::new(
                Point::origin(),
                Heading::from_radians(scan.ring.bearing(beam)),
            ),
            half_width: 0.0,
            range: *range,
            max_range: scan.ring.max_range,
        };
        Some(Snapshot {
            soundings: beams.map(sounding).collect(),
            picture: None,
        })
    }
}
