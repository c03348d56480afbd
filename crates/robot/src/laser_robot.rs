use tolman_geom::Heading;

use crate::{Odometry, Ring, Scan};

/// What a robot with a laser ring, a compass, wheel encoders and a bumper senses in one time step.
///
/// A sensor that gave nothing this time (a drop-out) is `None`; the other readings still hold.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LaserSensing {
    /// Microseconds since the robot was switched on.
    pub time_us: u64,
    /// The laser's ranges, in the robot's frame.
    pub scan: Option<Scan>,
    /// The compass: absolute heading, 0 is east.
    pub compass: Option<Heading>,
    /// What the wheels rolled since the step before.
    pub odometry: Option<Odometry>,
    /// Whether the body touched something in this step.
    pub bump: Option<bool>,
}

impl LaserSensing {
    /// Before the first reading: nothing sensed yet.
    #[must_use]
    pub fn silent(ring: Ring) -> Self {
        Self {
            time_us: 0,
            scan: Some(Scan::clear(ring)),
            compass: None,
            odometry: None,
            bump: None,
        }
    }
}
