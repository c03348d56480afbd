use tolman_geom::Heading;

use crate::{Odometry, Ring, Scan};

/// Readings of a robot with a laser ring, a compass, wheel encoders and a bumper in one time step.
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
    /// Odometry since the step before.
    pub odometry: Option<Odometry>,
    /// Whether the body touched something in this step.
    pub bump: Option<bool>,
}

impl LaserSensing {
    /// Returns the state before the first reading: a scan that met nothing, and no other readings.
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

impl AsRef<Self> for LaserSensing {
    fn as_ref(&self) -> &Self {
        self
    }
}

#[cfg(test)]
#[cfg(feature = "serde")]
mod tests {
    use tolman_geom::Heading;

    use super::*;
    use crate::TurnTranslate;

    /// Traces hold these, so the names must last, and no bit of a number may be lost.
    #[test]
    fn sensings_and_commands_survive_json() {
        let mut sensing = LaserSensing::silent(Ring::fan(3, 1.0, 0.1 + 0.2));
        sensing.time_us = u64::MAX;
        sensing.compass = Some(Heading::from_radians(-1.0 / 3.0));
        sensing.odometry = Some(Odometry {
            distance: 1e-300,
            turn: -0.7,
        });
        let json = serde_json::to_string(&sensing).unwrap();
        assert_eq!(
            json,
            "{\"time_us\":18446744073709551615,\"scan\":{\"ring\":{\"beams\":3,\
             \"first_bearing\":-0.5,\"spacing\":0.5,\"max_range\":0.30000000000000004},\
             \"ranges\":[0.30000000000000004,0.30000000000000004,0.30000000000000004]},\
             \"compass\":-0.3333333333333333,\"odometry\":{\"distance\":1e-300,\"turn\":-0.7},\
             \"bump\":null}"
        );
        assert_eq!(
            serde_json::from_str::<LaserSensing>(&json).unwrap(),
            sensing
        );

        let command = TurnTranslate {
            turn: -0.25,
            translate: 1.0,
        };
        let json = serde_json::to_string(&command).unwrap();
        assert_eq!(json, "{\"turn\":-0.25,\"translate\":1.0}");
        assert_eq!(
            serde_json::from_str::<TurnTranslate>(&json).unwrap(),
            command
        );
    }
}
