use thiserror::Error;
use tolman_geom::{OutOfRange, Twist};
use tolman_robot::pioneer_2dx::{
    Pioneer2dxSensing, SONAR_LEAST, SONAR_MOST, SONARS, TRACK, body, sonar_mounts,
};
use tolman_robot::{Body, Odometry, Picture, TurnTranslate};

use super::{MotorNoise, names, noisy};
use crate::noise::{Disturbances, Fault, Faults, FaultsError, Gaussian};
use crate::sensors::{PictureCamera, PictureCameraConfig, Sensor, SonarConfig, Sonars};
use crate::trace::Recordable;
use crate::{Chance, CommandError, Contact, Model, Motion, Surroundings};

/// The robot of the place map: a Pioneer 2-DX with sixteen sonars, wheel encoders and a colour
/// camera.
///
/// Source: A. Goldhoorn, H. Stadman, H. Eldering, "Implementation of a Simultaneous Localization
/// and Mapping system using Growing Neural Gas", 2006, section 3.1; the vendor's drawings for what
/// the paper leaves out.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Pioneer2dxConfig {
    /// Turn made in one step by the command `turn = 1`, rad.
    pub turn_per_step: f64,
    /// Distance covered in one step by the command `translate = 1`, m.
    pub translate_per_step: f64,
    /// Errors of the motors.
    pub motor_noise: MotorNoise,
    /// Encoder counts as a share of the distance that a wheel rolled: a constant error.
    pub wheel_scale: WheelScale,
    /// Noise of the distance that each wheel counts in a step, m: slip.
    pub wheel_noise: Gaussian,
    /// Parameters of the sonars.
    pub sonar: SonarConfig,
    /// Parameters of the camera.
    pub camera: PictureCameraConfig,
    /// Other faults of motors and sensors.
    #[serde(default)]
    pub faults: Pioneer2dxFaults,
    /// Behaviour where the body meets something.
    pub contact: Contact,
    /// Length of a time step, µs.
    pub step_us: u64,
}

/// Encoder counts of each wheel as a share of the distance that it rolled: 1 for a calibrated
/// robot.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WheelScale {
    /// Calibration of the left wheel.
    pub left: f64,
    /// Calibration of the right wheel.
    pub right: f64,
}

impl WheelScale {
    /// Calibration without errors.
    pub const EXACT: Self = Self {
        left: 1.0,
        right: 1.0,
    };

    pub(super) fn is_exact(&self) -> bool {
        *self == Self::EXACT
    }

    /// Returns the motion by the encoders of a robot that makes `motion`, computed with the nominal
    /// track.
    pub(super) fn counted(self, motion: Motion) -> Motion {
        if self.is_exact() {
            return motion;
        }
        let half_turn = 0.5 * motion.turn * TRACK;
        let left = (motion.distance - half_turn) * self.left;
        let right = (motion.distance + half_turn) * self.right;
        let counted = Twist::of_wheels(left, right, TRACK);
        Motion {
            distance: counted.linear,
            turn: counted.angular,
        }
    }
}

impl Default for WheelScale {
    fn default() -> Self {
        Self::EXACT
    }
}

/// Faults of a robot beyond plain noise; each list applies in order, after the noise.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Pioneer2dxFaults {
    /// Faults of the turn the motors make, rad; a drop-out makes none.
    pub motor_turn: Vec<Fault>,
    /// Faults of the distance the motors make, m; a drop-out makes none.
    pub motor_distance: Vec<Fault>,
    /// Faults of the distance that the left wheel counts, m; a drop-out removes the whole odometry.
    pub left_wheel: Vec<Fault>,
    /// Faults of the distance that the right wheel counts, m; a drop-out removes the whole
    /// odometry.
    pub right_wheel: Vec<Fault>,
    /// Faults of the sonars' ranges, m.
    pub sonars: Vec<Fault>,
    /// Faults of red, green and blue of every pixel, 0 … 255.
    pub picture: Vec<Fault>,
}

/// Disturbances, by a crate of your own, of a robot's motors and sensors. Each list applies in
/// order, after the faults.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Pioneer2dxDisturbances {
    /// Disturbances of the turn the motors make, rad; no error if missing.
    pub motor_turn: Disturbances<f64>,
    /// Disturbances of the distance the motors make, m; no error if missing.
    pub motor_distance: Disturbances<f64>,
    /// Disturbances of the distance that the left wheel counts, m; a missing reading removes the
    /// whole odometry.
    pub left_wheel: Disturbances<f64>,
    /// Disturbances of the distance that the right wheel counts, m; a missing reading removes the
    /// whole odometry.
    pub right_wheel: Disturbances<f64>,
    /// Disturbances of the sonars' ranges, m.
    pub sonars: Disturbances<[f64; SONARS]>,
    /// Disturbances of the picture.
    pub picture: Disturbances<Picture>,
}

impl Pioneer2dxConfig {
    /// Returns a robot with perfect motors and sensors in steady light: 0.4 m/s and 115°/s at most,
    /// ten time steps a second.
    #[must_use]
    pub fn noiseless() -> Self {
        Self {
            turn_per_step: 0.2,
            translate_per_step: 0.04,
            motor_noise: MotorNoise::default(),
            wheel_scale: WheelScale::EXACT,
            wheel_noise: Gaussian::NONE,
            sonar: SonarConfig::noiseless(),
            camera: PictureCameraConfig::noiseless(),
            faults: Pioneer2dxFaults::default(),
            contact: Contact::Slide,
            step_us: 100_000,
        }
    }

    /// Returns the paper's robot with its noise, for which the paper gives no values: wheels that
    /// slip by 2 % per step, noisy sonars, changing light.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            motor_noise: MotorNoise {
                turn: Gaussian::relative(0.05),
                translate: Gaussian::relative(0.03),
                drift_sd: 0.03,
            },
            wheel_noise: Gaussian::relative(0.02),
            sonar: SonarConfig::noisy(),
            camera: PictureCameraConfig::noisy(),
            ..Self::noiseless()
        }
    }

    /// Returns the same robot with wheels that have constant counting errors.
    #[must_use]
    pub fn with_wheel_scale(mut self, wheel_scale: WheelScale) -> Self {
        self.wheel_scale = wheel_scale;
        self
    }

    fn check(&self) -> Result<(), Pioneer2dxError> {
        let rates = [
            ("turn_per_step", self.turn_per_step),
            ("translate_per_step", self.translate_per_step),
            ("motor_noise.drift_sd", self.motor_noise.drift_sd),
            ("wheel_scale.left", self.wheel_scale.left),
            ("wheel_scale.right", self.wheel_scale.right),
        ];
        let noises = [
            ("motor_noise.turn", self.motor_noise.turn),
            ("motor_noise.translate", self.motor_noise.translate),
            ("wheel_noise", self.wheel_noise),
        ];
        let sds = noises
            .iter()
            .flat_map(|(field, noise)| [(*field, noise.relative_sd), (*field, noise.absolute_sd)]);
        for (field, value) in sds.chain(rates) {
            OutOfRange::check(field, value, 0.0..=1e3)?;
        }
        match self.step_us {
            0 => Err(Pioneer2dxError::NoTime),
            _ => self.check_faults(),
        }
    }

    fn check_faults(&self) -> Result<(), Pioneer2dxError> {
        let faults = &self.faults;
        let all = [
            ("faults.motor_turn", &faults.motor_turn),
            ("faults.motor_distance", &faults.motor_distance),
            ("faults.left_wheel", &faults.left_wheel),
            ("faults.right_wheel", &faults.right_wheel),
            ("faults.sonars", &faults.sonars),
            ("faults.picture", &faults.picture),
        ];
        for (field, faults) in all {
            Fault::check_all(field, faults)?;
        }
        Ok(())
    }
}

/// A robot built to a [`Pioneer2dxConfig`].
#[derive(Clone, Debug)]
pub struct Pioneer2dx {
    config: Pioneer2dxConfig,
    body: Body,
    motor_turn: Faults<f64>,
    motor_distance: Faults<f64>,
    left_wheel: Faults<f64>,
    right_wheel: Faults<f64>,
    sonars: Sonars<SONARS>,
    sonar_faults: Faults<[f64; SONARS]>,
    camera: PictureCamera,
    picture: Faults<Picture>,
}

impl Pioneer2dx {
    /// Builds the robot.
    ///
    /// # Errors
    /// If a field of the configuration is invalid.
    pub fn new(config: Pioneer2dxConfig) -> Result<Self, Pioneer2dxError> {
        config.check()?;
        let (motors, faults) = (&config.motor_noise, &config.faults);
        Ok(Self {
            body: body(),
            motor_turn: noisy("motor turn", motors.turn, &faults.motor_turn),
            motor_distance: noisy("motor distance", motors.translate, &faults.motor_distance),
            left_wheel: noisy("left wheel", config.wheel_noise, &faults.left_wheel),
            right_wheel: noisy("right wheel", config.wheel_noise, &faults.right_wheel),
            sonars: Sonars::new(sonar_mounts(), config.sonar).map_err(Pioneer2dxError::Sonar)?,
            sonar_faults: Faults::new("sonars", faults.sonars.iter().copied()),
            camera: PictureCamera::new(config.camera).map_err(Pioneer2dxError::Camera)?,
            picture: Faults::new("picture", faults.picture.iter().copied()),
            config,
        })
    }

    /// Adds disturbances from outside. A trace of the robot names them, and replays only with
    /// [`replay_with`](crate::trace::replay_with).
    #[must_use]
    pub fn with_disturbances(mut self, outside: Pioneer2dxDisturbances) -> Self {
        self.motor_turn.add(outside.motor_turn);
        self.motor_distance.add(outside.motor_distance);
        self.left_wheel.add(outside.left_wheel);
        self.right_wheel.add(outside.right_wheel);
        self.sonar_faults.add(outside.sonars);
        self.picture.add(outside.picture);
        self
    }

    /// Returns the odometry of a motion. Each wheel counts its distance; distance and turn of the
    /// robot follow by the nominal track.
    fn rolled(&mut self, motion: Motion, chance: &Chance) -> Option<Odometry> {
        let half_turn = 0.5 * motion.turn * TRACK;
        let scale = self.config.wheel_scale;
        let mut left = Some((motion.distance - half_turn) * scale.left);
        let mut right = Some((motion.distance + half_turn) * scale.right);
        self.left_wheel.disturb(&mut left, chance);
        self.right_wheel.disturb(&mut right, chance);
        let rolled = Twist::of_wheels(left?, right?, TRACK);
        Some(Odometry {
            distance: rolled.linear,
            turn: rolled.angular,
        })
    }
}

impl Model for Pioneer2dx {
    type Command = TurnTranslate;
    type Sensing = Pioneer2dxSensing;

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

    fn silent(&self) -> Pioneer2dxSensing {
        Pioneer2dxSensing::SILENT
    }

    fn sense(
        &mut self,
        around: &Surroundings<'_>,
        chance: &Chance,
        sensing: &mut Pioneer2dxSensing,
    ) {
        sensing.time_us = around.truth.time_us;
        self.sonars.sense(around, chance, &mut sensing.sonars);
        self.sonar_faults.disturb(&mut sensing.sonars, chance);
        if let Some(ranges) = &mut sensing.sonars {
            *ranges = ranges.map(|range| range.clamp(SONAR_LEAST, SONAR_MOST));
        }
        self.camera.sense(around, chance, &mut sensing.picture);
        self.picture.disturb(&mut sensing.picture, chance);
        sensing.odometry = self.rolled(around.truth.motion, chance);
        sensing.bump = Some(around.truth.bump);
    }
}

impl Recordable for Pioneer2dx {
    type Config = Pioneer2dxConfig;
    type ConfigError = Pioneer2dxError;

    fn config(&self) -> &Pioneer2dxConfig {
        &self.config
    }

    fn from_config(config: Pioneer2dxConfig) -> Result<Self, Pioneer2dxError> {
        Self::new(config)
    }

    fn disturbances(&self) -> Vec<String> {
        names("motor_turn", &self.motor_turn)
            .chain(names("motor_distance", &self.motor_distance))
            .chain(names("left_wheel", &self.left_wheel))
            .chain(names("right_wheel", &self.right_wheel))
            .chain(names("sonars", &self.sonar_faults))
            .chain(names("picture", &self.picture))
            .collect()
    }
}

/// Reason why a Pioneer 2-DX cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Pioneer2dxError {
    /// A number of the configuration is invalid.
    #[error(transparent)]
    Field(#[from] OutOfRange),
    /// A time step has length 0.
    #[error("`step_us` is 0; give at least 1 µs")]
    NoTime,
    /// A fault is invalid.
    #[error(transparent)]
    Fault(#[from] FaultsError),
    /// The sonars cannot be built.
    #[error("`sonar`: {0}")]
    Sonar(#[source] OutOfRange),
    /// The camera cannot be built.
    #[error("`camera`: {0}")]
    Camera(#[source] OutOfRange),
}
