use thiserror::Error;
use tolman_robot::{Body, LaserSensing, Ring, TurnTranslate};

use crate::noise::{Disturbance, Gaussian};
use crate::sensors::{Bumper, Compass, Laser, LaserError, Sensor, WheelOdometry};
use crate::{BodyError, Chance, Channel, CommandError, Contact, Model, Motion, Surroundings, body};

/// The robot of MSLST: a Pioneer-like disc that turns in place, with a laser ring and a compass.
///
/// One "robot unit" of the paper is the diameter of the body.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LaserPioneerConfig {
    /// Radius of the body, m.
    pub radius: f64,
    /// The laser's beams.
    pub ring: Ring,
    /// Turn made in one step by the command `turn = 1`, rad. The paper gives no unit.
    pub turn_per_step: f64,
    /// Way covered in one step by the command `translate = 1`, m. The paper gives no unit.
    pub translate_per_step: f64,
    /// How far the motors miss.
    pub motor_noise: MotorNoise,
    /// Noise of each range, m.
    pub scan_noise: Gaussian,
    /// Noise of the compass, rad.
    pub compass_noise: Gaussian,
    /// Noise of the rolled distance, m.
    pub odometry_distance_noise: Gaussian,
    /// Noise of the rolled turn, rad.
    pub odometry_turn_noise: Gaussian,
    /// What happens where the body meets something.
    pub contact: Contact,
    /// Length of a time step, µs.
    pub step_us: u64,
}

/// How far a turn-and-translate drive misses its command. A motor that is not driven keeps still.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MotorNoise {
    /// Noise of a commanded turn, rad.
    pub turn: Gaussian,
    /// Noise of a commanded translation, m.
    pub translate: Gaussian,
    /// Standard deviation of the unwanted turn, rad per metre translated.
    pub drift_sd: f64,
}

impl LaserPioneerConfig {
    /// A robot of the paper's proportions with perfect motors and sensors: 72 beams all round that
    /// reach 2.5 robot units, a robot unit being 0.5 m.
    #[must_use]
    pub fn noiseless() -> Self {
        Self {
            radius: 0.25,
            ring: Ring::full(72, 1.25),
            turn_per_step: 1.0,
            translate_per_step: 0.5,
            motor_noise: MotorNoise::default(),
            scan_noise: Gaussian::NONE,
            compass_noise: Gaussian::NONE,
            odometry_distance_noise: Gaussian::NONE,
            odometry_turn_noise: Gaussian::NONE,
            contact: Contact::Slide,
            step_us: 100_000,
        }
    }

    fn check(&self) -> Result<(), ConfigError> {
        let noises = [
            ("motor_noise.turn", self.motor_noise.turn),
            ("motor_noise.translate", self.motor_noise.translate),
            ("scan_noise", self.scan_noise),
            ("compass_noise", self.compass_noise),
            ("odometry_distance_noise", self.odometry_distance_noise),
            ("odometry_turn_noise", self.odometry_turn_noise),
        ];
        let sds = noises
            .iter()
            .flat_map(|(field, noise)| [(*field, noise.relative_sd), (*field, noise.absolute_sd)]);
        let rates = [
            ("turn_per_step", self.turn_per_step),
            ("translate_per_step", self.translate_per_step),
            ("motor_noise.drift_sd", self.motor_noise.drift_sd),
        ];
        for (field, value) in sds.chain(rates) {
            if !(0.0..=1e3).contains(&value) {
                return Err(ConfigError::Field { field, value });
            }
        }
        if self.step_us == 0 {
            return Err(ConfigError::Field {
                field: "step_us",
                value: 0.0,
            });
        }
        Ok(())
    }
}

/// A robot built to a [`LaserPioneerConfig`].
#[derive(Clone, Debug)]
pub struct LaserPioneer {
    config: LaserPioneerConfig,
    body: Body,
    laser: Laser,
    compass: Compass,
    odometry: WheelOdometry,
    bumper: Bumper,
}

impl LaserPioneer {
    /// Builds one.
    ///
    /// # Errors
    /// If a field of the configuration has no sense.
    pub fn new(config: LaserPioneerConfig) -> Result<Self, ConfigError> {
        config.check()?;
        let body = Body::Circle {
            radius: config.radius,
        };
        body::check(&body)?;
        Ok(Self {
            body,
            laser: Laser::new(config.ring)?,
            compass: Compass,
            odometry: WheelOdometry,
            bumper: Bumper,
            config,
        })
    }

    /// What it was built to.
    #[must_use]
    pub fn config(&self) -> &LaserPioneerConfig {
        &self.config
    }
}

impl Model for LaserPioneer {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;

    fn body(&self) -> &Body {
        &self.body
    }

    fn contact(&self) -> Contact {
        self.config.contact
    }

    fn step_us(&self) -> u64 {
        self.config.step_us
    }

    fn check(&self, command: &TurnTranslate) -> Result<(), CommandError> {
        CommandError::check("turn", command.turn)?;
        CommandError::check("translate", command.translate)
    }

    /// Commands beyond −1 … 1 count as full rate. Turn and translation of one step happen together,
    /// along an arc.
    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        let noise = &self.config.motor_noise;
        let mut turn = command.turn.clamp(-1.0, 1.0) * self.config.turn_per_step;
        let mut distance = command.translate.clamp(-1.0, 1.0) * self.config.translate_per_step;
        if turn.abs() > 0.0 {
            turn = noise
                .turn
                .around(turn, &mut chance.draws(Channel::named("turn motor")));
        }
        if distance.abs() > 0.0 {
            let draws = &mut chance.draws(Channel::named("translate motor"));
            distance = noise.translate.around(distance, draws);
            let drift = Gaussian::absolute(noise.drift_sd * distance.abs());
            turn = drift.around(turn, &mut chance.draws(Channel::named("drift")));
        }
        Motion { distance, turn }
    }

    fn silent(&self) -> LaserSensing {
        LaserSensing::silent(self.config.ring)
    }

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut LaserSensing) {
        let config = &mut self.config;
        let draws = |name| chance.draws(Channel::named(name));
        sensing.time_us = around.time_us;
        self.laser.sense(around, chance, &mut sensing.scan);
        config
            .scan_noise
            .disturb(&mut sensing.scan, &mut draws("scan"));
        self.compass.sense(around, chance, &mut sensing.compass);
        config
            .compass_noise
            .disturb(&mut sensing.compass, &mut draws("compass"));
        self.odometry.sense(around, chance, &mut sensing.odometry);
        if let Some(odometry) = &mut sensing.odometry {
            let (distance, turn) = (&config.odometry_distance_noise, &config.odometry_turn_noise);
            odometry.distance = distance.around(odometry.distance, &mut draws("odometry distance"));
            odometry.turn = turn.around(odometry.turn, &mut draws("odometry turn"));
        }
        self.bumper.sense(around, chance, &mut sensing.bump);
    }
}

/// Why a robot cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A number of the configuration has no sense.
    #[error("`{field}` is {value}; give a number from 0 to 1000 (a time step must be positive)")]
    Field {
        /// Which field.
        field: &'static str,
        /// What it says.
        value: f64,
    },
    /// The laser cannot be built.
    #[error("`ring`: {0}")]
    Laser(#[from] LaserError),
    /// The body cannot be one.
    #[error("`radius`: {0}")]
    Body(#[from] BodyError),
}
