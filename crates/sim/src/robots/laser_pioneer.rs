use thiserror::Error;
use tolman_geom::{Heading, OutOfRange};
use tolman_robot::{Body, LaserSensing, Odometry, Ring, Scan, TurnTranslate};

use super::{WheelScale, names, noisy};
use crate::noise::{Disturbances, Fault, Faults, FaultsError, Gaussian};
use crate::sensors::{Laser, LaserError, Sensor};
use crate::trace::Recordable;
use crate::{BodyError, Chance, Channel, CommandError, Contact, Model, Motion, Surroundings, body};

/// The robot of MSLST: a Pioneer-like disc that turns in place, with a laser ring and a compass.
///
/// One "robot unit" of the paper is the diameter of the body.
///
/// ```
/// use tolman_robot::Ring;
/// use tolman_sim::noise::Gaussian;
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
///
/// let mut config = LaserPioneerConfig::noiseless();
/// config.ring = Ring::fan(180, core::f64::consts::PI, 8.0);
/// config.scan_noise = Gaussian::absolute(0.01);
/// LaserPioneer::new(config.clone())?;
/// // What has no sense is refused by name.
/// config.radius = -1.0;
/// let error = LaserPioneer::new(config).unwrap_err();
/// assert!(error.to_string().contains("radius"));
/// # Ok::<(), tolman_sim::robots::RobotConfigError>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LaserPioneerConfig {
    /// Radius of the body, m.
    pub radius: f64,
    /// The laser's beams.
    pub ring: Ring,
    /// Turn made in one step by the command `turn = 1`, rad. The paper gives no unit.
    pub turn_per_step: f64,
    /// Distance covered in one step by the command `translate = 1`, m. The paper gives no unit.
    pub translate_per_step: f64,
    /// Errors of the motors.
    pub motor_noise: MotorNoise,
    /// Noise of each range, m.
    pub scan_noise: Gaussian,
    /// Noise of the compass, rad.
    pub compass_noise: Gaussian,
    /// Encoder counts as a share of the distance that a wheel rolled: a constant error. The wheels
    /// are as far apart as the Pioneer 2-DX's.
    #[serde(default, skip_serializing_if = "WheelScale::is_exact")]
    pub wheel_scale: WheelScale,
    /// Noise of the rolled distance, m.
    pub odometry_distance_noise: Gaussian,
    /// Noise of the rolled turn, rad.
    pub odometry_turn_noise: Gaussian,
    /// Other faults of motors and sensors.
    #[serde(default)]
    pub faults: LaserPioneerFaults,
    /// Behaviour where the body meets something.
    pub contact: Contact,
    /// Length of a time step, µs.
    pub step_us: u64,
}

/// Errors of a turn-and-translate drive against its command. A motor that is not driven keeps
/// still.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct MotorNoise {
    /// Noise of a commanded turn, rad.
    pub turn: Gaussian,
    /// Noise of a commanded translation, m.
    pub translate: Gaussian,
    /// Standard deviation of the unwanted turn, rad per metre translated.
    pub drift_sd: f64,
}

impl MotorNoise {
    /// Returns the motion of a step in which turn and translation are commanded as shares of full
    /// rate. Commands beyond −1 … 1 count as full rate. Both happen together, along an arc.
    pub(super) fn motion(
        &self,
        commands: [f64; 2],
        full: [f64; 2],
        [of_turn, of_distance]: [&mut Faults<f64>; 2],
        chance: &Chance,
    ) -> Motion {
        let driven = |at: usize, faults: &mut Faults<f64>| {
            let mut made = Some(commands[at].clamp(-1.0, 1.0) * full[at]);
            // A motor that is not driven keeps still.
            if commands[at].abs() > 0.0 {
                faults.disturb(&mut made, chance);
            }
            made.unwrap_or(0.0)
        };
        let (turn, distance) = (driven(0, of_turn), driven(1, of_distance));
        let drift = Gaussian::absolute(self.drift_sd * distance.abs());
        Motion {
            distance,
            turn: drift.around(turn, &mut chance.draws(Channel::named("drift"))),
        }
    }
}

/// Faults of a robot beyond plain noise; each list applies in order, after the noise.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct LaserPioneerFaults {
    /// Faults of the turn that the motors make, rad. A drop-out makes none.
    pub motor_turn: Vec<Fault>,
    /// Faults of the distance that the motors make, m. A drop-out makes none.
    pub motor_distance: Vec<Fault>,
    /// Faults of each range, m.
    pub scan: Vec<Fault>,
    /// Faults of the compass, rad.
    pub compass: Vec<Fault>,
    /// Faults of the distance that the wheels report, m. A drop-out drops the whole odometry.
    pub odometry_distance: Vec<Fault>,
    /// Faults of the turn that the wheels report, rad. A drop-out drops the whole odometry.
    pub odometry_turn: Vec<Fault>,
    /// Beams that always report the same range, after all faults of the scan.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stuck_beams: Vec<StuckBeam>,
}

/// A beam of a laser that reports the same range whatever it meets.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StuckBeam {
    /// Number of the beam in the ring.
    pub beam: u32,
    /// Reported range, m: 0 up to the ring's range.
    pub range: f64,
}

/// Disturbances, by a crate of your own, of a robot's motors and sensors. Each list applies in
/// order, after the faults. They are not in the configuration, since code cannot be written to a
/// file.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LaserPioneerDisturbances {
    /// Errors of the turn that the motors make, rad.
    pub motor_turn: Disturbances<f64>,
    /// Errors of the distance that the motors make, m.
    pub motor_distance: Disturbances<f64>,
    /// Errors of the scan's ranges, m.
    pub scan: Disturbances<Scan>,
    /// Errors of the compass, rad.
    pub compass: Disturbances<Heading>,
    /// Errors of the distance that the wheels report, m. Without it the whole odometry is missing.
    pub odometry_distance: Disturbances<f64>,
    /// Errors of the turn that the wheels report, rad. Without it the whole odometry is missing.
    pub odometry_turn: Disturbances<f64>,
}

impl LaserPioneerConfig {
    /// Returns a robot of the paper's proportions with perfect motors and sensors. It has 72 beams
    /// all round that reach 2.5 robot units; a robot unit is 0.5 m.
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
            wheel_scale: WheelScale::EXACT,
            odometry_distance_noise: Gaussian::NONE,
            odometry_turn_noise: Gaussian::NONE,
            faults: LaserPioneerFaults::default(),
            contact: Contact::Slide,
            step_us: 100_000,
        }
    }

    fn check(&self) -> Result<(), RobotConfigError> {
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
            ("wheel_scale.left", self.wheel_scale.left),
            ("wheel_scale.right", self.wheel_scale.right),
        ];
        for (field, value) in sds.chain(rates) {
            OutOfRange::check(field, value, 0.0..=1e3)?;
        }
        let faults = [
            ("faults.motor_turn", &self.faults.motor_turn),
            ("faults.motor_distance", &self.faults.motor_distance),
            ("faults.scan", &self.faults.scan),
            ("faults.compass", &self.faults.compass),
            ("faults.odometry_distance", &self.faults.odometry_distance),
            ("faults.odometry_turn", &self.faults.odometry_turn),
        ];
        for (field, faults) in faults {
            Fault::check_all(field, faults)?;
        }
        for StuckBeam { beam, range } in &self.faults.stuck_beams {
            if *beam >= self.ring.beams || !(0.0..=self.ring.max_range).contains(range) {
                let (beam, range) = (*beam, *range);
                return Err(RobotConfigError::StuckBeam { beam, range });
            }
        }
        match self.step_us {
            0 => Err(RobotConfigError::NoTime),
            _ => Ok(()),
        }
    }
}

/// A robot built to a [`LaserPioneerConfig`].
#[derive(Clone, Debug)]
pub struct LaserPioneer {
    config: LaserPioneerConfig,
    body: Body,
    motor_turn: Faults<f64>,
    motor_distance: Faults<f64>,
    laser: Laser,
    scan: Faults<Scan>,
    compass: Faults<Heading>,
    odometry_distance: Faults<f64>,
    odometry_turn: Faults<f64>,
}

impl LaserPioneer {
    /// Builds the robot.
    ///
    /// # Errors
    /// If a field of the configuration is invalid.
    pub fn new(config: LaserPioneerConfig) -> Result<Self, RobotConfigError> {
        config.check()?;
        let body = Body::Circle {
            radius: config.radius,
        };
        body::check(&body)?;
        let laser = Laser::new(config.ring)?;
        let (motors, faults) = (&config.motor_noise, &config.faults);
        let rolled = config.odometry_distance_noise;
        let turned = config.odometry_turn_noise;
        Ok(Self {
            body,
            motor_turn: noisy("motor turn", motors.turn, &faults.motor_turn),
            motor_distance: noisy("motor distance", motors.translate, &faults.motor_distance),
            laser,
            scan: noisy("scan", config.scan_noise, &faults.scan),
            compass: noisy("compass", config.compass_noise, &faults.compass),
            odometry_distance: noisy("odometry distance", rolled, &faults.odometry_distance),
            odometry_turn: noisy("odometry turn", turned, &faults.odometry_turn),
            config,
        })
    }

    /// Adds disturbances from outside. A trace of the robot names them, and replays only with
    /// [`replay_with`](crate::trace::replay_with).
    #[must_use]
    pub fn with_disturbances(mut self, outside: LaserPioneerDisturbances) -> Self {
        self.motor_turn.add(outside.motor_turn);
        self.motor_distance.add(outside.motor_distance);
        self.scan.add(outside.scan);
        self.compass.add(outside.compass);
        self.odometry_distance.add(outside.odometry_distance);
        self.odometry_turn.add(outside.odometry_turn);
        self
    }

    /// Returns the robot's configuration.
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

    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        let config = &self.config;
        config.motor_noise.motion(
            [command.turn, command.translate],
            [config.turn_per_step, config.translate_per_step],
            [&mut self.motor_turn, &mut self.motor_distance],
            chance,
        )
    }

    fn silent(&self) -> LaserSensing {
        LaserSensing::silent(self.config.ring)
    }

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut LaserSensing) {
        sensing.time_us = around.truth.time_us;
        self.laser.sense(around, chance, &mut sensing.scan);
        self.scan.disturb(&mut sensing.scan, chance);
        if let Some(scan) = &mut sensing.scan {
            for StuckBeam { beam, range } in &self.config.faults.stuck_beams {
                if let Some(stuck) = scan.ranges.get_mut(*beam as usize) {
                    *stuck = *range;
                }
            }
        }
        sensing.compass = Some(around.truth.pose.heading);
        self.compass.disturb(&mut sensing.compass, chance);
        // Wheels that a contact holds do not roll.
        let counted = self.config.wheel_scale.counted(around.truth.motion);
        let (mut distance, mut turn) = (Some(counted.distance), Some(counted.turn));
        self.odometry_distance.disturb(&mut distance, chance);
        self.odometry_turn.disturb(&mut turn, chance);
        sensing.odometry = distance
            .zip(turn)
            .map(|(distance, turn)| Odometry { distance, turn });
        sensing.bump = Some(around.truth.bump);
    }
}

impl Recordable for LaserPioneer {
    type Config = LaserPioneerConfig;
    type ConfigError = RobotConfigError;

    fn config(&self) -> &LaserPioneerConfig {
        &self.config
    }

    fn from_config(config: LaserPioneerConfig) -> Result<Self, RobotConfigError> {
        Self::new(config)
    }

    fn disturbances(&self) -> Vec<String> {
        names("motor_turn", &self.motor_turn)
            .chain(names("motor_distance", &self.motor_distance))
            .chain(names("scan", &self.scan))
            .chain(names("compass", &self.compass))
            .chain(names("odometry_distance", &self.odometry_distance))
            .chain(names("odometry_turn", &self.odometry_turn))
            .collect()
    }
}

/// Reason why a robot cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RobotConfigError {
    /// A number of the configuration is invalid.
    #[error(transparent)]
    Field(#[from] OutOfRange),
    /// A time step has length 0.
    #[error("`step_us` is 0; give at least 1 µs")]
    NoTime,
    /// A stuck beam is not in the ring, or its range is not one that the ring can read.
    #[error(
        "`faults.stuck_beams`: beam {beam} stuck at {range} m; name a beam of the ring and a range within its own"
    )]
    StuckBeam {
        /// Number of the beam.
        beam: u32,
        /// The range given, m.
        range: f64,
    },
    /// A fault is invalid.
    #[error(transparent)]
    Fault(#[from] FaultsError),
    /// The laser cannot be built.
    #[error("`ring`: {0}")]
    Laser(#[from] LaserError),
    /// The body is invalid.
    #[error("`radius`: {0}")]
    Body(#[from] BodyError),
}
