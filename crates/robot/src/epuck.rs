//! The e-puck: its measures, its sensing and its commands.

use core::f64::consts::{PI, TAU};

use tolman_geom::{Heading, Point, Pose, Twist};

/// Radius of the body, m.
pub const BODY_RADIUS: f64 = 0.037;

/// Radius of a wheel, m.
pub const WHEEL_RADIUS: f64 = 0.0205;

/// Distance between the wheels, m.
pub const TRACK: f64 = 0.053;

/// Maximum speed of the real robot's wheels, rad/s: about 0.13 m/s ahead, or 4.9 rad/s in place.
#[expect(clippy::approx_constant, reason = "the data sheet says 6.28, not 2π")]
pub const MOST_WHEEL_SPEED: f64 = 6.28;

/// Resolution of the encoders, rad: a thousandth of a turn, as the motor has 20 steps per turn
/// behind a gear of ratio 50.
pub const ENCODER_STEP: f64 = TAU / 1000.0;

/// Number of proximity sensors.
pub const PROXIMITY_SENSORS: usize = 8;

/// Position (m) and direction (degrees) of each proximity sensor. Number 0 looks ahead, a little to
/// the right; the others follow clockwise.
const MOUNTS: [(f64, f64, f64); PROXIMITY_SENSORS] = [
    (-17.2, 0.030, -0.010),
    (-45.9, 0.022, -0.025),
    (-90.0, 0.0, -0.031),
    (-151.5, -0.030, -0.015),
    (151.2, -0.030, 0.015),
    (90.0, 0.0, 0.031),
    (45.8, 0.022, 0.025),
    (17.1, 0.030, 0.010),
];

/// Returns the pose of each proximity sensor in the robot's frame.
///
/// ```
/// use tolman_robot::epuck;
///
/// let ahead_right = epuck::proximity_mounts()[0];
/// assert!(ahead_right.position.x > 0.0 && ahead_right.position.y < 0.0);
/// assert!((ahead_right.heading.degrees() + 17.2).abs() < 1e-9);
/// ```
#[must_use]
pub fn proximity_mounts() -> [Pose; PROXIMITY_SENSORS] {
    MOUNTS.map(|(degrees, x, y)| {
        Pose::new(
            Point::new(x, y),
            Heading::from_radians(degrees * PI / 180.0),
        )
    })
}

/// The command of a robot with two driven wheels: the speed of each, rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelSpeeds {
    /// Speed of the left wheel, rad/s; positive rolls ahead.
    pub left: f64,
    /// Speed of the right wheel, rad/s; positive rolls ahead.
    pub right: f64,
}

impl WheelSpeeds {
    /// Wheel speeds of a robot that stands still.
    pub const STOP: Self = Self {
        left: 0.0,
        right: 0.0,
    };

    /// Returns the wheel speeds, rad/s, at which the robot moves by `twist` (m/s, rad/s). If a
    /// wheel would turn faster than `most`, rad/s, both are slowed alike, so that the path is the
    /// same.
    ///
    /// ```
    /// use tolman_geom::Twist;
    /// use tolman_robot::epuck::{MOST_WHEEL_SPEED, WheelSpeeds};
    ///
    /// let spin = WheelSpeeds::of_twist(Twist { linear: 0.0, angular: 100.0 }, MOST_WHEEL_SPEED);
    /// assert_eq!((spin.left, spin.right), (-MOST_WHEEL_SPEED, MOST_WHEEL_SPEED));
    /// ```
    #[must_use]
    pub fn of_twist(twist: Twist, most: f64) -> Self {
        let apart = twist.angular * TRACK / 2.0;
        let (left, right) = (
            (twist.linear - apart) / WHEEL_RADIUS,
            (twist.linear + apart) / WHEEL_RADIUS,
        );
        let slow = (most / left.abs().max(right.abs())).min(1.0);
        Self {
            left: left * slow,
            right: right * slow,
        }
    }
}

impl crate::Standstill for WheelSpeeds {
    const STOP: Self = Self::STOP;
}

/// Turn of each wheel in a time step, rad, whether the robot moved or not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelTurns {
    /// Turn of the left wheel, rad; positive is ahead.
    pub left: f64,
    /// Turn of the right wheel, rad; positive is ahead.
    pub right: f64,
}

/// Readings of an e-puck in one time step. A sensor without a reading is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EpuckSensing {
    /// Microseconds since the robot was switched on.
    pub time_us: u64,
    /// The proximity sensors' raw values, in the order of [`proximity_mounts`]: the larger the
    /// nearer.
    pub proximity: Option<[f64; PROXIMITY_SENSORS]>,
    /// Turns of the wheels since the step before.
    pub encoders: Option<WheelTurns>,
    /// Whether the body touched something in this step; `None` for the real robot, which has no
    /// bumper.
    pub bump: Option<bool>,
}

#[cfg(test)]
#[cfg(feature = "serde")]
mod tests {
    use super::*;

    /// Traces hold these, so the names must last.
    #[test]
    fn sensings_and_commands_survive_json() {
        let sensing = EpuckSensing {
            time_us: 7,
            proximity: Some([0.5; PROXIMITY_SENSORS]),
            encoders: Some(WheelTurns {
                left: 0.1,
                right: -0.2,
            }),
            bump: None,
        };
        let json = serde_json::to_string(&sensing).unwrap();
        assert_eq!(
            json,
            "{\"time_us\":7,\"proximity\":[0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5],\
             \"encoders\":{\"left\":0.1,\"right\":-0.2},\"bump\":null}"
        );
        assert_eq!(
            serde_json::from_str::<EpuckSensing>(&json).unwrap(),
            sensing
        );
        let command = WheelSpeeds {
            left: 1.0,
            right: -2.0,
        };
        let json = serde_json::to_string(&command).unwrap();
        assert_eq!(json, "{\"left\":1.0,\"right\":-2.0}");
        assert_eq!(serde_json::from_str::<WheelSpeeds>(&json).unwrap(), command);
    }
}
