use thiserror::Error;
use tolman_robot::{Body, CameraSensing, ColumnImage, TurnTranslate};

use super::{LaserPioneer, LaserPioneerConfig, LaserPioneerDisturbances, RobotConfigError, names};
use crate::noise::{Disturbances, Fault, Faults, FaultsError};
use crate::sensors::{CameraError, ColumnCamera, Sensor};
use crate::trace::Recordable;
use crate::{Chance, CommandError, Contact, Model, Motion, Surroundings};

/// A [`LaserPioneer`] with a [`ColumnCamera`].
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct CameraPioneerConfig {
    /// Number of columns of the camera's image.
    pub columns: u32,
    /// Range of the camera, m.
    pub reach: f64,
    /// Faults of each measurement of the image, which is a share of full light.
    #[serde(default)]
    pub image: Vec<Fault>,
    /// Configuration of all parts but the camera.
    pub pioneer: LaserPioneerConfig,
}

impl CameraPioneerConfig {
    /// Returns this Pioneer with a camera of `columns` columns that reaches `reach` m, without
    /// faults.
    #[must_use]
    pub const fn new(pioneer: LaserPioneerConfig, columns: u32, reach: f64) -> Self {
        Self {
            columns,
            reach,
            image: Vec::new(),
            pioneer,
        }
    }
}

/// Disturbances, by a crate of your own, of the robot's motors and sensors, after the faults.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct CameraPioneerDisturbances {
    /// Errors of the camera's image, in shares of full light.
    pub image: Disturbances<ColumnImage>,
    /// Errors of all other values.
    pub pioneer: LaserPioneerDisturbances,
}

/// A robot built to a [`CameraPioneerConfig`].
#[derive(Clone, Debug)]
pub struct CameraPioneer {
    config: CameraPioneerConfig,
    pioneer: LaserPioneer,
    camera: ColumnCamera,
    image: Faults<ColumnImage>,
}

impl CameraPioneer {
    /// Builds the robot.
    ///
    /// # Errors
    /// If a field of the configuration is invalid.
    pub fn new(config: CameraPioneerConfig) -> Result<Self, CameraPioneerError> {
        Fault::check_all("image", &config.image)?;
        Ok(Self {
            pioneer: LaserPioneer::new(config.pioneer.clone())?,
            camera: ColumnCamera::new(config.columns, config.reach)?,
            image: Faults::new("image", config.image.clone()),
            config,
        })
    }

    /// Adds disturbances from outside.
    #[must_use]
    pub fn with_disturbances(mut self, outside: CameraPioneerDisturbances) -> Self {
        self.pioneer = self.pioneer.with_disturbances(outside.pioneer);
        self.image.add(outside.image);
        self
    }
}

impl Model for CameraPioneer {
    type Command = TurnTranslate;
    type Sensing = CameraSensing;

    fn body(&self) -> &Body {
        self.pioneer.body()
    }

    fn contact(&self) -> Contact {
        self.pioneer.contact()
    }

    fn step_us(&self) -> u64 {
        self.pioneer.step_us()
    }

    fn check(&self, command: &TurnTranslate) -> Result<(), CommandError> {
        self.pioneer.check(command)
    }

    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        self.pioneer.motion(command, chance)
    }

    fn silent(&self) -> CameraSensing {
        CameraSensing {
            laser: self.pioneer.silent(),
            image: Some(ColumnImage::black(self.config.columns)),
        }
    }

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut CameraSensing) {
        self.pioneer.sense(around, chance, &mut sensing.laser);
        self.camera.sense(around, chance, &mut sensing.image);
        self.image.disturb(&mut sensing.image, chance);
    }
}

impl Recordable for CameraPioneer {
    type Config = CameraPioneerConfig;
    type ConfigError = CameraPioneerError;

    fn config(&self) -> &CameraPioneerConfig {
        &self.config
    }

    fn from_config(config: CameraPioneerConfig) -> Result<Self, CameraPioneerError> {
        Self::new(config)
    }

    fn disturbances(&self) -> Vec<String> {
        let mut all = self.pioneer.disturbances();
        all.extend(names("image", &self.image));
        all
    }
}

/// Reason why a robot with a camera cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CameraPioneerError {
    /// A fault is invalid.
    #[error(transparent)]
    Fault(#[from] FaultsError),
    /// The camera cannot be built.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The rest cannot be built.
    #[error("`pioneer`: {0}")]
    Pioneer(#[from] RobotConfigError),
}
