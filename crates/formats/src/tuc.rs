//! Reads the SLAM data set of the Chemnitz University of Technology: places that looked alike, and
//! odometry of wheels and gyroscope.
//!
//! ```text
//! odom2 time vx vy turn_rate var_vx var_vy var_turn_rate
//! loop time earlier_time similarity
//! point2 time x y covariance…
//! ```
//!
//! Source: P. Neubert, S. Schubert, P. Protzel, IEEE Robotics and Automation Letters 2019, and the
//! data set's readme.

use std::path::Path;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{TimedPose, Trajectory};

use crate::fields::{Fields, Wrong};
use crate::log::{self, LogError, LogReport, LogTrouble, LogVelocity};

/// A drive, with pairs of places that look alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TucDrive {
    /// Speeds of the robot.
    pub odometry: Vec<LogVelocity>,
    /// Pairs of places that look alike, true and false ones.
    pub matches: Vec<PlaceMatch>,
    /// Report on reading the file.
    pub report: LogReport,
}

/// Two times at which places looked alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceMatch {
    /// The later time, s.
    pub time: f64,
    /// The earlier time, s.
    pub earlier: f64,
    /// Similarity, 0 to 1.
    pub similarity: f64,
}

/// Contents of a line.
enum TucLine {
    Velocity(LogVelocity),
    Match(PlaceMatch),
}

impl TucDrive {
    /// Reads a file of the robot's readings, plain or gzipped.
    ///
    /// # Errors
    /// If there is no such file, or no line of it can be used.
    pub fn read(path: &Path) -> Result<Self, LogError> {
        let (lines, report) = log::read_records(path, "odom2 … or loop …", sensed)?;
        let mut drive = Self {
            report,
            ..Self::default()
        };
        for line in lines {
            match line {
                TucLine::Velocity(velocity) => drive.odometry.push(velocity),
                TucLine::Match(places) => drive.matches.push(places),
            }
        }
        Ok(drive)
    }

    /// Reads a file of the robot's positions. These lines have no heading: all poses look east.
    ///
    /// # Errors
    /// If there is no such file, or no line of it can be used.
    pub fn read_truth(path: &Path) -> Result<Trajectory, LogError> {
        let (points, _) = log::read_records(path, "point2 time x y", point)?;
        Ok(Trajectory::new(points.into_iter().flatten()))
    }
}

fn sensed(fields: &mut Fields<'_>) -> Result<TucLine, Wrong> {
    match fields.word("the kind")? {
        "odom2" => Ok(TucLine::Velocity(LogVelocity {
            time: fields.number("the time")?,
            forward: fields.number("the velocity ahead")?,
            left: fields.number("the velocity to the left")?,
            turn: fields.number("the turn rate")?,
        })),
        "loop" => Ok(TucLine::Match(PlaceMatch {
            time: fields.number("the time")?,
            earlier: fields.number("the earlier time")?,
            similarity: fields.number("the similarity")?,
        })),
        kind => Err(unknown(kind)),
    }
}

fn point(fields: &mut Fields<'_>) -> Result<Option<TimedPose>, Wrong> {
    match fields.word("the kind")? {
        "point2" => {
            let time = fields.number("the time")?;
            let position = Point::new(fields.number("x")?, fields.number("y")?);
            let pose = Pose::new(position, Heading::EAST);
            Ok(Some(TimedPose { time, pose }))
        }
        // The true readings of the gyroscope are not used.
        "angle" => Ok(None),
        kind => Err(unknown(kind)),
    }
}

fn unknown(kind: &str) -> Wrong {
    let kind: String = kind.chars().take(24).collect();
    (LogTrouble::UnknownKind, format!("`{kind}`"))
}
