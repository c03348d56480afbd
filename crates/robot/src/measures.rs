use core::f64::consts::{FRAC_PI_2, TAU};

use thiserror::Error;
use tolman_geom::{OutOfRange, POSITIVE};

use crate::Ring;

/// Measures of a robot with a laser and of its corridors: all that a system has to be told.
///
/// Lengths are metres, angles radians.
///
/// ```
/// use tolman_robot::{LaserMeasures, RobotMeasures};
///
/// // A robot that turns on a circle 0.25 m across, in corridors twice as wide.
/// let laser = LaserMeasures::all_round(360, 0.12, 3.5);
/// let measures = RobotMeasures::new(0.25, 0.5, laser);
/// assert_eq!(measures.check(), Ok(()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct RobotMeasures {
    /// Diameter of the circle that the body covers when it turns in place, m.
    pub diameter: f64,
    /// Distance between the faces of a corridor's walls, m.
    pub corridor_width: f64,
    /// Distance from the middle of one corridor to that of the next, m, where all are the same;
    /// `None` if it is not known.
    #[cfg_attr(feature = "serde", serde(default))]
    pub corridor_spacing: Option<f64>,
    /// The laser.
    pub laser: LaserMeasures,
    /// Largest error of the compass, rad; `None` without a compass.
    #[cfg_attr(feature = "serde", serde(default))]
    pub compass_error: Option<f64>,
    /// Largest error of odometry, as a share of the distance; `None` without odometry.
    #[cfg_attr(feature = "serde", serde(default))]
    pub odometry_error: Option<f64>,
    /// The longest motion in one time step.
    #[cfg_attr(feature = "serde", serde(default))]
    pub step: Option<StepMeasures>,
}

/// The longest motion of a robot in one time step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct StepMeasures {
    /// Turn of the command `turn: 1.0`, rad.
    pub turn: f64,
    /// Distance of the command `translate: 1.0`, m.
    pub distance: f64,
}

/// Measures of a laser that turns, and of its place on the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct LaserMeasures {
    /// Number of ranges in a reading.
    pub beams: u32,
    /// Bearing of the first beam in the laser's own frame, rad.
    #[cfg_attr(feature = "serde", serde(default))]
    pub first_bearing: f64,
    /// Bearing from one beam to the next in the laser's own frame, rad; `None` if the beams are
    /// spread evenly over the whole circle.
    #[cfg_attr(feature = "serde", serde(default))]
    pub spacing: Option<f64>,
    /// Nearest distance that it measures, m. What reads less has met nothing.
    #[cfg_attr(feature = "serde", serde(default))]
    pub least_range: f64,
    /// Farthest distance that it measures, m. What reads as much or more has met nothing.
    pub max_range: f64,
    /// Distance of the laser ahead of the middle of the axle, m.
    #[cfg_attr(feature = "serde", serde(default))]
    pub x: f64,
    /// Distance of the laser to the left of the middle of the axle, m.
    #[cfg_attr(feature = "serde", serde(default))]
    pub y: f64,
    /// Direction of the laser's own frame on the robot, rad.
    #[cfg_attr(feature = "serde", serde(default))]
    pub heading: f64,
    /// Whether it is mounted upside down, so that its bearings count clockwise.
    #[cfg_attr(feature = "serde", serde(default))]
    pub upside_down: bool,
}

/// Reason why measures fit no robot.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeasuresError {
    /// A number is out of its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The robot does not fit its corridors.
    #[error(
        "the robot is {diameter} m across and its corridors are {corridor_width} m wide: give a `corridor_width` above the `diameter`"
    )]
    TooWide {
        /// Diameter of the robot, m.
        diameter: f64,
        /// Width of the corridors, m.
        corridor_width: f64,
    },
    /// Corridors overlap.
    #[error(
        "corridors {width} m wide cannot lie {spacing} m apart: give a `corridor_spacing` of at least the `corridor_width`"
    )]
    Overlap {
        /// Width of the corridors, m.
        width: f64,
        /// Distance between their middles, m.
        spacing: f64,
    },
    /// The laser does not see the walls of a corridor.
    #[error(
        "the laser measures from {least} to {most} m, and corridors are {corridor_width} m wide: it needs to see from {near:.3} to {far:.3} m"
    )]
    Laser {
        /// Nearest distance that it measures, m.
        least: f64,
        /// Farthest distance that it measures, m.
        most: f64,
        /// Width of the corridors, m.
        corridor_width: f64,
        /// Nearest wall that it has to see, m.
        near: f64,
        /// Farthest wall that it has to see, m.
        far: f64,
    },
    /// The laser does not see all round.
    #[error(
        "the laser's {beams} beams cover {degrees:.0}°: a system needs a view all round; turn the robot and put several readings together"
    )]
    NotRound {
        /// Number of beams.
        beams: u32,
        /// Angle that they cover, degrees.
        degrees: f64,
    },
    /// The laser is not on the robot.
    #[error(
        "the laser is {off} m from the middle of a robot {diameter} m across; correct its `x` and `y`"
    )]
    OffTheRobot {
        /// Distance from the middle of the axle, m.
        off: f64,
        /// Diameter of the robot, m.
        diameter: f64,
    },
    /// A sense or a measure is missing that the system needs.
    #[error("it needs `{field}`, and the measures do not give it")]
    Missing {
        /// Field of [`RobotMeasures`].
        field: &'static str,
    },
}

/// Farthest wall that a system looks at, in widths of a corridor.
const FAR: f64 = 4.0 / 3.0;

/// Smallest bearing that a full circle may lack, as a share of the spacing of its beams.
const GAP: f64 = 0.5;

impl RobotMeasures {
    /// Returns the measures of a robot with a compass and odometry of usual quality: 4° and 5 %.
    #[must_use]
    pub const fn new(diameter: f64, corridor_width: f64, laser: LaserMeasures) -> Self {
        Self {
            diameter,
            corridor_width,
            corridor_spacing: None,
            laser,
            compass_error: Some(4.0 * core::f64::consts::PI / 180.0),
            odometry_error: Some(0.05),
            step: None,
        }
    }

    /// Returns the longest motion in a time step; if none was given, a quarter circle and two
    /// diameters.
    #[must_use]
    pub fn step(&self) -> StepMeasures {
        self.step.unwrap_or(StepMeasures {
            turn: FRAC_PI_2,
            distance: 2.0 * self.diameter,
        })
    }

    /// Checks that the measures do not contradict each other.
    ///
    /// # Errors
    /// [`MeasuresError`] with the first contradiction.
    pub fn check(&self) -> Result<(), MeasuresError> {
        let Self {
            diameter,
            corridor_width,
            laser,
            ..
        } = *self;
        let step = self.step();
        OutOfRange::check("diameter", diameter, POSITIVE)?;
        OutOfRange::check("corridor_width", corridor_width, POSITIVE)?;
        OutOfRange::check("step.turn", step.turn, POSITIVE)?;
        OutOfRange::check("step.distance", step.distance, POSITIVE)?;
        OutOfRange::check(
            "compass_error",
            self.compass_error.unwrap_or(0.0),
            0.0..=1.0,
        )?;
        OutOfRange::check(
            "odometry_error",
            self.odometry_error.unwrap_or(0.0),
            0.0..=0.5,
        )?;
        laser.check()?;
        if corridor_width <= diameter {
            return Err(MeasuresError::TooWide {
                diameter,
                corridor_width,
            });
        }
        if let Some(spacing) = self.corridor_spacing {
            OutOfRange::check("corridor_spacing", spacing, POSITIVE)?;
            if spacing < corridor_width {
                return Err(MeasuresError::Overlap {
                    width: corridor_width,
                    spacing,
                });
            }
        }
        let off = libm::hypot(laser.x, laser.y);
        if off > diameter {
            return Err(MeasuresError::OffTheRobot { off, diameter });
        }
        // In the middle of a corridor it has to see both walls, and the end of a cell.
        let (near, far) = (0.5 * corridor_width - off, FAR * corridor_width + off);
        if laser.least_range > near || laser.max_range < far {
            return Err(MeasuresError::Laser {
                least: laser.least_range,
                most: laser.max_range,
                corridor_width,
                near,
                far,
            });
        }
        Ok(())
    }
}

impl LaserMeasures {
    /// Returns a laser above the middle of the axle, whose `beams` are spread over the whole
    /// circle, the first of them ahead. It measures from `least_range` to `max_range`, m.
    #[must_use]
    pub const fn all_round(beams: u32, least_range: f64, max_range: f64) -> Self {
        Self {
            beams,
            first_bearing: 0.0,
            spacing: None,
            least_range,
            max_range,
            x: 0.0,
            y: 0.0,
            heading: 0.0,
            upside_down: false,
        }
    }

    /// Returns the beams in the robot's frame, as seen from the laser.
    #[must_use]
    pub fn ring(&self) -> Ring {
        let spacing = self.spacing.unwrap_or(TAU / f64::from(self.beams));
        let side = if self.upside_down { -1.0 } else { 1.0 };
        Ring {
            beams: self.beams,
            first_bearing: self.heading + side * self.first_bearing,
            spacing: side * spacing,
            max_range: self.max_range,
        }
    }

    fn check(&self) -> Result<(), MeasuresError> {
        OutOfRange::check("laser.beams", f64::from(self.beams), 8.0..=100_000.0)?;
        OutOfRange::check("laser.least_range", self.least_range, 0.0..)?;
        OutOfRange::check("laser.max_range", self.max_range, POSITIVE)?;
        let ring = self.ring();
        for (field, angle) in [
            ("laser.first_bearing", self.first_bearing),
            ("laser.spacing", ring.spacing),
            ("laser.heading", self.heading),
        ] {
            OutOfRange::check(field, angle, -TAU..=TAU)?;
        }
        for (field, length) in [("laser.x", self.x), ("laser.y", self.y)] {
            OutOfRange::check(field, length, ..)?;
        }
        let round = f64::from(self.beams) * ring.spacing.abs();
        let gap = (TAU - round).abs();
        // Some lasers give the beam ahead twice, as their first and last.
        if gap > (1.0 + GAP) * ring.spacing.abs() {
            return Err(MeasuresError::NotRound {
                beams: self.beams,
                degrees: round.to_degrees(),
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sound() -> RobotMeasures {
        RobotMeasures::new(0.25, 0.5, LaserMeasures::all_round(360, 0.12, 3.5))
    }

    #[test]
    fn measures_that_contradict_each_other_are_refused() {
        assert_eq!(sound().check(), Ok(()));
        let told = |change: fn(&mut RobotMeasures)| {
            let mut measures = sound();
            change(&mut measures);
            alloc::format!("{}", measures.check().unwrap_err())
        };
        for (told, expected) in [
            (told(|it| it.diameter = f64::NAN), "`diameter` is NaN"),
            (told(|it| it.diameter = 0.5), "a `corridor_width` above"),
            (
                told(|it| it.corridor_spacing = Some(0.4)),
                "`corridor_spacing` of at least",
            ),
            (
                told(|it| it.laser.least_range = 0.3),
                "measures from 0.3 to 3.5 m",
            ),
            (
                told(|it| it.laser.max_range = 0.5),
                "needs to see from 0.250 to 0.667 m",
            ),
            (told(|it| it.laser.spacing = Some(0.01)), "cover 206°"),
            (told(|it| it.laser.x = -0.3), "0.3 m from the middle"),
            (told(|it| it.laser.beams = 0), "`laser.beams` is 0"),
            (
                told(|it| it.odometry_error = Some(2.0)),
                "`odometry_error` is 2",
            ),
        ] {
            assert!(told.contains(expected), "{told}");
        }
    }

    #[test]
    fn a_laser_upside_down_counts_clockwise() {
        let mut laser = LaserMeasures::all_round(4, 0.0, 1.0);
        laser.upside_down = true;
        laser.heading = FRAC_PI_2;
        // Its first beam looks left, the second ahead.
        assert!((laser.ring().bearing(0) - FRAC_PI_2).abs() < 1e-12);
        assert!(laser.ring().bearing(1).abs() < 1e-12);
    }
}
