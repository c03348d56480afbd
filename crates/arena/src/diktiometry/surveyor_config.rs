use tolman_robot::{Body, CameraSensing, Ring};
use tolman_sim::Contact;
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{CameraPioneerConfig, LaserPioneerConfig};
use tolman_systems::diktiometry::{CameraEye, Eye, LaserEye, NoEye, RoutineConfig, SenseError};

use crate::pioneer::{CAMERA_PIONEER, LASER_PIONEER, calibrated};

/// A simulated Pioneer and the bounds of its errors. [`SurveyorConfig::paper`] fills in our values
/// where the paper gives none.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct SurveyorConfig {
    /// Body, laser and motors. The errors of compass and odometry below are added to its own.
    pub pioneer: LaserPioneerConfig,
    /// Cue by which the robot tells places apart.
    pub sight: PlaceCue,
    /// Largest error of odometry as a share of the distance, 0 … 0.5. Paper: "about 10% of distance
    /// travelled".
    pub odometry_share: f64,
    /// Largest additional error of scale that all odometry of a run shares, as a share of the
    /// distance, 0 to 0.5. It models a wrong calibration; the mapper knows its bound.
    #[serde(default, skip_serializing_if = "is_none")]
    pub shared_share: f64,
    /// Probability that odometry is wrong by four times its bound, 0 to 1, drawn as often as other
    /// errors. The mapper does not know about outliers.
    #[serde(default, skip_serializing_if = "is_none")]
    pub outliers: f64,
    /// Largest error of the compass, rad.
    pub compass_bound: f64,
    /// Number of time steps that an error of odometry or compass stays the same, ≥ 1. The longer,
    /// the less errors average out within a move. At the largest number there is, a calibration is
    /// wrong all along.
    pub hold_steps: u32,
    /// Largest distance from the middle of a place at which a control routine stops, m.
    pub place_radius: f64,
}

/// Error of an outlier of odometry, as a multiple of the bound.
const OUTLYING: f64 = 4.0;

/// Returns whether an error is 0; files then leave it out.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
fn is_none(error: &f64) -> bool {
    *error <= 0.0
}

/// Cue by which a robot tells places apart.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub enum PlaceCue {
    /// The colours that a camera sees all round.
    Camera {
        /// Number of columns of the image.
        columns: u32,
        /// Standard deviation of each colour measurement, as a share of full light.
        colour_sd: f64,
    },
    /// The ways that lead on; walls look the same.
    Exits,
    /// The ranges of the robot's laser, as shares of its reach.
    Laser {
        /// Number of columns that the beams are averaged to.
        columns: u32,
    },
}

impl SurveyorConfig {
    /// Returns odometry with errors of 10 % and a compass of ± 4°, as in the paper's figures. An
    /// error lasts about as long as a move.
    #[must_use]
    pub fn paper() -> Self {
        let mut pioneer = LaserPioneerConfig::noiseless();
        pioneer.ring = Ring::full(180, 4.0);
        pioneer.motor_noise.turn = Gaussian::relative(0.1);
        pioneer.motor_noise.translate = Gaussian::relative(0.1);
        pioneer.motor_noise.drift_sd = 0.02;
        pioneer.contact = Contact::Slide;
        Self {
            pioneer,
            sight: PlaceCue::Camera {
                columns: 24,
                colour_sd: 0.02,
            },
            odometry_share: 0.1,
            shared_share: 0.0,
            outliers: 0.0,
            compass_bound: 4_f64.to_radians(),
            hold_steps: 50,
            place_radius: 0.07,
        }
    }

    /// Returns the robot of MSLST, with its motors and its ring of 72 beams, and the same bounds on
    /// odometry and compass.
    #[must_use]
    pub fn mslst() -> Self {
        Self {
            pioneer: calibrated(),
            sight: PlaceCue::Laser { columns: 24 },
            place_radius: 0.1,
            ..Self::paper()
        }
    }

    /// Returns the robot's name, which follows from its cue for places.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self.sight {
            PlaceCue::Camera { .. } | PlaceCue::Exits => CAMERA_PIONEER,
            PlaceCue::Laser { .. } => LASER_PIONEER,
        }
    }

    /// Returns the robot's outline.
    #[must_use]
    pub const fn body(&self) -> Body {
        Body::Circle {
            radius: self.pioneer.radius,
        }
    }

    /// Returns the Pioneer with the errors of its compass and odometry.
    #[must_use]
    pub fn laser_robot(&self) -> LaserPioneerConfig {
        let bounded = |share: f64, offset: f64| Fault::Bounded {
            share,
            offset,
            steps: self.hold_steps,
        };
        let mut pioneer = self.pioneer.clone();
        let faults = &mut pioneer.faults;
        faults.compass.push(bounded(0.0, self.compass_bound));
        let distance = bounded(self.odometry_share, 0.0);
        faults.odometry_distance.push(distance);
        if self.shared_share > 0.0 {
            faults.odometry_distance.push(Fault::Bounded {
                share: self.shared_share,
                offset: 0.0,
                steps: u32::MAX,
            });
        }
        if self.outliers > 0.0 {
            faults.odometry_distance.push(Fault::Lapse {
                probability: self.outliers,
                share: OUTLYING * self.odometry_share,
                steps: self.hold_steps,
            });
        }
        pioneer
    }

    /// Returns the same Pioneer with a camera.
    pub(super) fn camera_robot(&self) -> CameraPioneerConfig {
        let (columns, colour_sd) = match self.sight {
            PlaceCue::Camera { columns, colour_sd } => (columns, colour_sd),
            // It is not used.
            PlaceCue::Laser { .. } | PlaceCue::Exits => (1, 0.0),
        };
        let mut robot = CameraPioneerConfig::new(self.laser_robot(), columns, 20.0);
        robot.image = vec![Fault::Gaussian(Gaussian::absolute(colour_sd))];
        robot
    }

    /// Returns the configuration of the control routines for this robot in corridors
    /// `corridor_width` wide, m, without doorways.
    #[must_use]
    pub fn routines(&self, corridor_width: f64) -> RoutineConfig {
        let LaserPioneerConfig {
            turn_per_step,
            translate_per_step,
            ..
        } = self.pioneer;
        let mut routines = RoutineConfig::new(corridor_width, turn_per_step, translate_per_step);
        routines.odometry_share = self.odometry_share;
        routines.compass_bound = self.compass_bound;
        routines
    }
}

impl Eye<CameraSensing> for PlaceCue {
    fn columns(&self, sensing: &CameraSensing) -> Result<Option<Vec<Vec<f64>>>, SenseError> {
        match *self {
            Self::Camera { .. } => CameraEye.columns(sensing),
            Self::Laser { columns } => LaserEye { columns }.columns(sensing),
            Self::Exits => NoEye.columns(sensing),
        }
    }
}
