//! The multi-robot data set of the University of Toronto (UTIAS MRCLAM, K. Leung 2009): a folder
//! with one file of each kind per robot.
//!
//! ```text
//! RobotN_Odometry.dat      time forward_velocity turn_rate
//! RobotN_Measurement.dat   time barcode range bearing
//! RobotN_Groundtruth.dat   time x y orientation
//! Barcodes.dat             subject barcode
//! ```
//!
//! Each may be gzipped, as `….dat.gz`. Subjects 1 to 5 are robots, the others landmarks.

use alloc::collections::BTreeMap;
use std::path::{Path, PathBuf};

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{TimedPose, Trajectory};

use crate::fields::{Fields, Wrong};
use crate::log::{self, LogError, LogReport, LogVelocity};

/// One robot of the data set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UtiasRobot {
    /// Speeds of the robot by its wheels.
    pub odometry: Vec<LogVelocity>,
    /// Barcodes that the robot's camera recognized.
    pub sightings: Vec<BarcodeSighting>,
    /// True trajectory, by cameras on the ceiling.
    pub truth: Trajectory,
    /// Report on reading each file.
    pub reports: Vec<(PathBuf, LogReport)>,
    /// Barcodes without a subject, with the number of readings of each.
    pub strangers: BTreeMap<u32, u32>,
}

/// A barcode that a robot's camera has read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarcodeSighting {
    /// Time of the sighting, s.
    pub time: f64,
    /// Number of the robot or landmark that wears the barcode.
    pub subject: u32,
    /// Distance of the subject, m.
    pub range: f64,
    /// Bearing of the subject, rad, counter-clockwise from straight ahead.
    pub bearing: f64,
}

/// Largest number of a robot; subjects with larger numbers are landmarks.
const ROBOTS: u32 = 5;

impl BarcodeSighting {
    /// Returns whether the subject is a landmark, which does not move.
    #[must_use]
    pub const fn is_landmark(&self) -> bool {
        self.subject > ROBOTS
    }
}

impl UtiasRobot {
    /// Reads the files of robot `number`, 1 to 5, in `folder`.
    ///
    /// # Errors
    /// If a file is not there, or no line of it can be used.
    pub fn read(folder: &Path, number: u32) -> Result<Self, LogError> {
        let mut robot = Self::default();
        let barcodes = robot.file(folder, "Barcodes.dat", "subject barcode", barcode)?;
        let barcodes: BTreeMap<u32, u32> = barcodes.into_iter().collect();
        let named = |kind: &str| format!("Robot{number}_{kind}.dat");
        let what = "time forward_velocity turn_rate";
        robot.odometry = robot.file(folder, &named("Odometry"), what, velocity)?;
        let what = "time barcode range bearing";
        let seen = robot.file(folder, &named("Measurement"), what, sighting)?;
        for sighting in seen {
            let Some(&subject) = barcodes.get(&sighting.subject) else {
                *robot.strangers.entry(sighting.subject).or_default() += 1;
                continue;
            };
            robot.sightings.push(BarcodeSighting {
                subject,
                ..sighting
            });
        }
        let truth = robot.file(folder, &named("Groundtruth"), "time x y orientation", pose)?;
        robot.truth = Trajectory::new(truth);
        Ok(robot)
    }

    fn file<T>(
        &mut self,
        folder: &Path,
        name: &str,
        what: &str,
        parse: impl Fn(&mut Fields<'_>) -> Result<T, Wrong>,
    ) -> Result<Vec<T>, LogError> {
        let [plain, packed] = [name.to_owned(), format!("{name}.gz")].map(|name| folder.join(name));
        let path = if packed.exists() { packed } else { plain };
        let (records, report) = log::read_records(&path, what, parse)?;
        self.reports.push((path, report));
        Ok(records)
    }
}

/// Returns a barcode and the number of the subject that wears it.
fn barcode(fields: &mut Fields<'_>) -> Result<(u32, u32), Wrong> {
    let subject = fields.count("the subject")?;
    Ok((fields.count("the barcode")?, subject))
}

fn velocity(fields: &mut Fields<'_>) -> Result<LogVelocity, Wrong> {
    Ok(LogVelocity {
        time: fields.number("the time")?,
        forward: fields.number("the velocity")?,
        left: 0.0,
        turn: fields.number("the turn rate")?,
    })
}

/// Returns a sighting whose `subject` still holds the barcode.
fn sighting(fields: &mut Fields<'_>) -> Result<BarcodeSighting, Wrong> {
    Ok(BarcodeSighting {
        time: fields.number("the time")?,
        subject: fields.count("the barcode")?,
        range: fields.number("the range")?,
        bearing: fields.number("the bearing")?,
    })
}

fn pose(fields: &mut Fields<'_>) -> Result<TimedPose, Wrong> {
    let time = fields.number("the time")?;
    let position = Point::new(fields.number("x")?, fields.number("y")?);
    let heading = Heading::from_radians(fields.number("the orientation")?);
    Ok(TimedPose {
        time,
        pose: Pose::new(position, heading),
    })
}
