use core::fmt;

use tolman_robot::{Body, LaserSensing, Ring, Scan, TurnTranslate};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig, RobotConfigError};
use tolman_sim::trace::Recordable;
use tolman_sim::{Chance, CommandError, Contact, Model, Motion, Surroundings};

use crate::diktiometry::SurveyorConfig;
use crate::pioneer::{ENCODER_SD, calibrated, with_sensor_noise};
use crate::{BoxError, Depicted};

/// A simulated robot by its name: the same robot with the same noise wherever it is named.
#[derive(Clone, Copy, Debug)]
pub struct RobotEntry {
    /// Name as typed, in kebab case.
    pub name: &'static str,
    /// Name in tables and in the files of maps.
    pub title: &'static str,
    /// Description in one line.
    pub about: &'static str,
    build: Build,
}

/// What a robot senses and how it is told to move. Systems ask for a kind, not for a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RobotKind {
    /// Eight infrared sensors near by, wheel encoders, wheel speeds.
    Epuck,
    /// A laser ring, a compass, encoders, turns and translations.
    Laser,
    /// The same with a camera that sees the colours of walls.
    Camera,
    /// Sonars, a camera, bumpers, encoders, turns and translations.
    Pioneer2dx,
}

/// A model that senses and moves as the laser Pioneer does.
pub trait LaserModel: Model<Command = TurnTranslate, Sensing = LaserSensing> {}

impl<M: Model<Command = TurnTranslate, Sensing = LaserSensing>> LaserModel for M {}

/// Builder of a laser robot from its configuration.
type Make = fn(LaserPioneerConfig) -> Result<Box<dyn LaserModel>, BoxError>;

#[derive(Clone, Copy, Debug)]
enum Build {
    Epuck,
    Camera,
    Pioneer2dx,
    Laser {
        config: fn() -> LaserPioneerConfig,
        make: Make,
    },
}

impl RobotKind {
    /// Returns what such a robot has, in words.
    #[must_use]
    pub const fn senses(self) -> &'static str {
        match self {
            Self::Epuck => "eight infrared sensors and encoders",
            Self::Laser => "a laser ring, a compass and encoders",
            Self::Camera => "a camera that sees colours, a laser ring, a compass and encoders",
            Self::Pioneer2dx => "sonars, a camera, bumpers and encoders",
        }
    }

    /// Returns whether such a robot can do all that one of the kind `other` can.
    #[must_use]
    pub fn can_be(self, other: Self) -> bool {
        self == other || (self == Self::Camera && other == Self::Laser)
    }

    /// Returns whether such a robot knows where north is.
    #[must_use]
    pub const fn has_compass(self) -> bool {
        matches!(self, Self::Laser | Self::Camera)
    }

    /// Returns whether such a robot sees the colours of walls.
    #[must_use]
    pub const fn sees_colours(self) -> bool {
        matches!(self, Self::Camera)
    }
}

impl RobotEntry {
    /// The e-puck of CPM.
    pub const EPUCK: Self = Self {
        name: "e-puck",
        title: "e-puck",
        about: "CPM's robot: eight infrared sensors, 7 cm across, wheels that slip",
        build: Build::Epuck,
    };

    /// The laser Pioneer of MSLST: noisy motors, exact sensors.
    pub const LASER_PIONEER: Self = Self::laser(
        "laser-pioneer",
        crate::pioneer::LASER_PIONEER,
        "MSLST's robot: 72 beams, a compass and encoders; noisy motors, exact sensors",
    );

    /// The laser Pioneer with errors of its encoders and its laser.
    pub const NOISY_PIONEER: Self = Self {
        build: Build::Laser {
            config: || with_sensor_noise(&calibrated(), ENCODER_SD),
            make: plain,
        },
        ..Self::laser(
            "noisy-pioneer",
            "noisy Pioneer",
            "the laser Pioneer with encoders and ranges that are off by 2 to 3 %",
        )
    };

    /// The camera Pioneer of the diktiometry.
    pub const CAMERA_PIONEER: Self = Self {
        name: "camera-pioneer",
        title: crate::pioneer::CAMERA_PIONEER,
        about: "the diktiometry's robot: a camera that sees colours, a laser and a compass, all with bounded errors",
        build: Build::Camera,
    };

    /// The Pioneer 2-DX of GNG-SLAM.
    pub const PIONEER_2DX: Self = Self {
        name: "pioneer-2-dx",
        title: crate::gngslam::PIONEER_2DX,
        about: "GNG-SLAM's robot: sonars, a camera, bumpers and encoders",
        build: Build::Pioneer2dx,
    };

    /// All robots of this project.
    pub const ALL: [Self; 5] = [
        Self::LASER_PIONEER,
        Self::NOISY_PIONEER,
        Self::CAMERA_PIONEER,
        Self::PIONEER_2DX,
        Self::EPUCK,
    ];

    /// Returns a robot that senses and moves as the laser Pioneer does. Without
    /// [`made_by`](Self::made_by) it is one.
    #[must_use]
    pub const fn laser(name: &'static str, title: &'static str, about: &'static str) -> Self {
        let build = Build::Laser {
            config: calibrated,
            make: plain,
        };
        Self {
            name,
            title,
            about,
            build,
        }
    }

    /// Returns a laser robot with this configuration, whose models `make` builds.
    #[must_use]
    pub const fn made_by(self, config: fn() -> LaserPioneerConfig, make: Make) -> Self {
        let build = Build::Laser { config, make };
        Self { build, ..self }
    }

    /// Returns what the robot senses and how it moves.
    #[must_use]
    pub const fn kind(&self) -> RobotKind {
        match self.build {
            Build::Epuck => RobotKind::Epuck,
            Build::Camera => RobotKind::Camera,
            Build::Pioneer2dx => RobotKind::Pioneer2dx,
            Build::Laser { .. } => RobotKind::Laser,
        }
    }

    /// Returns the configuration of a robot's laser, compass, encoders and motors; of a robot
    /// without a laser that of the laser Pioneer.
    #[must_use]
    pub fn laser_config(&self) -> LaserPioneerConfig {
        match self.build {
            Build::Laser { config, .. } => config(),
            Build::Camera => SurveyorConfig::paper().laser_robot(),
            Build::Epuck | Build::Pioneer2dx => calibrated(),
        }
    }

    /// Returns the model of a laser robot of this configuration.
    ///
    /// # Errors
    /// If the configuration is out of its bounds.
    pub fn laser_model(&self, config: LaserPioneerConfig) -> Result<LaserLike, BoxError> {
        let make = match self.build {
            Build::Laser { make, .. } => make,
            _ => plain,
        };
        Ok(LaserLike {
            title: self.title,
            model: make(config.clone())?,
            config,
            make,
        })
    }
}

fn plain(config: LaserPioneerConfig) -> Result<Box<dyn LaserModel>, BoxError> {
    Ok(Box::new(LaserPioneer::new(config)?))
}

/// Any robot that senses and moves as the laser Pioneer does.
pub struct LaserLike {
    title: &'static str,
    model: Box<dyn LaserModel>,
    config: LaserPioneerConfig,
    make: Make,
}

impl fmt::Debug for LaserLike {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("LaserLike").field(&self.title).finish()
    }
}

impl Model for LaserLike {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;

    fn body(&self) -> &Body {
        self.model.body()
    }

    fn contact(&self) -> Contact {
        self.model.contact()
    }

    fn step_us(&self) -> u64 {
        self.model.step_us()
    }

    fn check(&self, command: &TurnTranslate) -> Result<(), CommandError> {
        self.model.check(command)
    }

    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        self.model.motion(command, chance)
    }

    fn silent(&self) -> LaserSensing {
        self.model.silent()
    }

    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut LaserSensing) {
        self.model.sense(around, chance, sensing);
    }
}

impl Recordable for LaserLike {
    type Config = LaserPioneerConfig;
    type ConfigError = RobotConfigError;

    fn config(&self) -> &LaserPioneerConfig {
        &self.config
    }

    /// Builds the laser Pioneer; [`Depicted::again`] builds the same robot.
    fn from_config(config: LaserPioneerConfig) -> Result<Self, RobotConfigError> {
        Ok(Self {
            title: RobotEntry::LASER_PIONEER.title,
            model: Box::new(LaserPioneer::new(config.clone())?),
            config,
            make: plain,
        })
    }
}

impl Depicted for LaserLike {
    const NAME: &'static str = RobotEntry::LASER_PIONEER.title;

    fn name(&self) -> &'static str {
        self.title
    }

    fn again(&self) -> Result<Self, BoxError> {
        Ok(Self {
            title: self.title,
            model: (self.make)(self.config.clone())?,
            config: self.config.clone(),
            make: self.make,
        })
    }

    fn ring(&self) -> Option<Ring> {
        Some(self.config.ring)
    }

    fn scan(sensing: &Self::Sensing) -> Option<&Scan> {
        sensing.scan.as_ref()
    }
}
