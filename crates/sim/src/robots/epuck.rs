use thiserror::Error;
use tolman_geom::Twist;
use tolman_robot::Body;
use tolman_robot::epuck::{
    BODY_RADIUS, EpuckSensing, MOST_WHEEL_SPEED, PROXIMITY_SENSORS, TRACK, WHEEL_RADIUS,
    WheelSpeeds, WheelTurns, proximity_mounts,
};

use super::names;
use crate::noise::{Disturbances, Fault, Faults, FaultsError};
use crate::sensors::{Infrared, ResponseCurve, ResponseError, Sensor};
use crate::trace::Recordable;
use crate::{Chance, CommandError, Contact, Model, Motion, Surroundings};

/// The e-puck: a disc of 7.4 cm with two wheels and eight infrared proximity sensors.
///
/// Its measures are those of [`tolman_robot::epuck`]. The configuration has what differs between
/// simulated e-pucks.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct EpuckConfig {
    /// Response of the proximity sensors, with their noise.
    pub response: ResponseCurve,
    /// Faults of each wheel's distance over the ground, separately. A wheel with a drop-out does
    /// not roll.
    pub wheels: Vec<Fault>,
    /// Faults of the proximity values beyond the noise of the curve.
    #[serde(default)]
    pub proximity: Vec<Fault>,
    /// Behaviour where the body meets something.
    pub contact: Contact,
    /// Length of a time step, µs.
    pub step_us: u64,
    /// Maximum speed of a wheel, rad/s. The real robot's limit is [`MOST_WHEEL_SPEED`], with which
    /// it turns in place at up to 4.9 rad/s. The 2π rad/s of CPM's paper need an idealized robot
    /// with at least 8.2.
    #[serde(default = "real_wheels")]
    pub most_wheel_speed: f64,
}

const fn real_wheels() -> f64 {
    MOST_WHEEL_SPEED
}

impl EpuckConfig {
    /// Returns Webots' e-puck: its response curve, and wheels that slip by up to 10 %. A step is 10
    /// ms.
    #[must_use]
    pub fn webots() -> Self {
        Self {
            response: ResponseCurve::epuck(),
            wheels: vec![Fault::Slip { share: 0.1 }],
            proximity: Vec::new(),
            contact: Contact::Slide,
            step_us: 10_000,
            most_wheel_speed: MOST_WHEEL_SPEED,
        }
    }

    /// Returns CPM's e-puck: like Webots', but its sensors see 25 cm and answer from 0 to 3800.
    #[must_use]
    pub fn cpm() -> Self {
        Self {
            response: ResponseCurve::cpm(),
            ..Self::webots()
        }
    }
}

/// Disturbances, by a crate of your own, of an e-puck's wheels and sensors. Each list applies in
/// order, after the faults. They are not in the configuration, since code cannot be written to a
/// file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct EpuckDisturbances {
    /// Errors of the left wheel's distance over the ground, m. Without it the wheel does not roll.
    pub left_wheel: Disturbances<f64>,
    /// Errors of the right wheel's distance over the ground, m. Without it the wheel does not roll.
    pub right_wheel: Disturbances<f64>,
    /// Errors of the raw proximity values.
    pub proximity: Disturbances<[f64; PROXIMITY_SENSORS]>,
}

/// A robot built to an [`EpuckConfig`].
#[derive(Clone, Debug)]
pub struct Epuck {
    config: EpuckConfig,
    left: Faults<f64>,
    right: Faults<f64>,
    /// Turns of the wheels in this step.
    turned: WheelTurns,
    infrared: Infrared<PROXIMITY_SENSORS>,
    proximity: Faults<[f64; PROXIMITY_SENSORS]>,
}

impl Epuck {
    /// Builds the robot.
    ///
    /// # Errors
    /// If a field of the configuration is invalid.
    pub fn new(config: EpuckConfig) -> Result<Self, EpuckError> {
        if config.step_us == 0 {
            return Err(EpuckError::Step);
        }
        let most = config.most_wheel_speed;
        if !(most.is_finite() && most > 0.0) {
            return Err(EpuckError::WheelSpeed { most });
        }
        Fault::check_all("wheels", &config.wheels)?;
        Fault::check_all("proximity", &config.proximity)?;
        let infrared = Infrared::new(proximity_mounts(), config.response.clone())?;
        Ok(Self {
            left: Faults::new("left wheel", config.wheels.iter().copied()),
            right: Faults::new("right wheel", config.wheels.iter().copied()),
            turned: WheelTurns::default(),
            infrared,
            proximity: Faults::new("proximity", config.proximity.iter().copied()),
            config,
        })
    }

    /// Adds disturbances from outside. A trace of the robot names them, and replays only with
    /// [`replay_with`](crate::trace::replay_with).
    #[must_use]
    pub fn with_disturbances(mut self, outside: EpuckDisturbances) -> Self {
        self.left.add(outside.left_wheel);
        self.right.add(outside.right_wheel);
        self.proximity.add(outside.proximity);
        self
    }
}

impl Model for Epuck {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;

    fn body(&self) -> &Body {
        const BODY: Body = Body::Circle {
            radius: BODY_RADIUS,
        };
        &BODY
    }

    fn contact(&self) -> Contact {
        self.config.contact
    }

    fn step_us(&self) -> u64 {
        self.config.step_us
    }

    fn check(&self, command: &WheelSpeeds) -> Result<(), CommandError> {
        CommandError::check("left", command.left)?;
        CommandError::check("right", command.right)
    }

    /// Limits the speeds to those that the wheels can reach. The encoders report the wheels' turns,
    /// the motion their rolling over the ground.
    fn motion(&mut self, command: &WheelSpeeds, chance: &Chance) -> Motion {
        let seconds = self.config.step_us as f64 * 1e-6;
        let most = self.config.most_wheel_speed;
        let turned = |speed: f64| speed.clamp(-most, most) * seconds;
        self.turned = WheelTurns {
            left: turned(command.left),
            right: turned(command.right),
        };
        let rolled = |turned: f64, faults: &mut Faults<f64>| {
            let mut way = Some(turned * WHEEL_RADIUS);
            faults.disturb(&mut way, chance);
            way.unwrap_or(0.0)
        };
        let left = rolled(self.turned.left, &mut self.left);
        let right = rolled(self.turned.right, &mut self.right);
        let Twist { linear, angular } = Twist::of_wheels(left, right, TRACK);
        Motion {
            distance: linear,
            turn: angular,
        }
    }

    fn silent(&self) -> EpuckSensing {
        EpuckSensing::default()
    }

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut EpuckSensing) {
        sensing.time_us = around.truth.time_us;
        self.infrared.sense(around, chance, &mut sensing.proximity);
        self.proximity.disturb(&mut sensing.proximity, chance);
        sensing.encoders = Some(self.turned);
        sensing.bump = Some(around.truth.bump);
    }
}

impl Recordable for Epuck {
    type Config = EpuckConfig;
    type ConfigError = EpuckError;

    fn config(&self) -> &EpuckConfig {
        &self.config
    }

    fn from_config(config: EpuckConfig) -> Result<Self, EpuckError> {
        Self::new(config)
    }

    fn disturbances(&self) -> Vec<String> {
        names("left_wheel", &self.left)
            .chain(names("right_wheel", &self.right))
            .chain(names("proximity", &self.proximity))
            .collect()
    }
}

/// Reason why an e-puck cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EpuckError {
    /// A time step has length 0.
    #[error("`step_us` is 0; give the microseconds of a time step")]
    Step,
    /// The wheels can turn at no speed.
    #[error("`most_wheel_speed` is {most}; give radians a second above 0, 6.28 for the real robot")]
    WheelSpeed {
        /// The value given, rad/s.
        most: f64,
    },
    /// A fault is invalid.
    #[error(transparent)]
    Fault(#[from] FaultsError),
    /// The response curve is invalid.
    #[error("`response`: {0}")]
    Response(#[from] ResponseError),
}
