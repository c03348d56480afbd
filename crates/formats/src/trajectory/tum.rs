use core::fmt::Write;
use std::io::BufRead;
use std::path::Path;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{TimedPose, Trajectory};

use crate::fields::{Fields, Wrong};
use crate::log::{self, LogError, LogReport};
use crate::quaternion;

/// Returns a trajectory as text, one pose per line, `time x y z qx qy qz qw`. It is the format of
/// the RGB-D benchmark of the Technical University of Munich, which evo and others read.
///
/// ```
/// use tolman_formats::{ReadTrajectory, tum};
/// let text = "0.500000 1.000000 2.000000 0 0 0 0.000000000 1.000000000\n";
/// let read = ReadTrajectory::from_lines(text.as_bytes());
/// assert_eq!(tum(&read.trajectory), text);
/// ```
#[must_use]
pub fn tum(trajectory: &Trajectory) -> String {
    let mut text = String::new();
    for TimedPose { time, pose } in trajectory.poses() {
        let half = Heading::from_radians(0.5 * pose.heading.radians()).unit();
        let Point { coords } = pose.position;
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{time:.6} {:.6} {:.6} 0 0 0 {:.9} {:.9}",
            coords.x, coords.y, half.y, half.x
        );
    }
    text
}

/// A trajectory read from lines `time x y z qx qy qz qw`.
///
/// ```
/// use tolman_formats::ReadTrajectory;
///
/// let text = "# time x y z qx qy qz qw\n1.0 2.0 3.0 0 0 0 0 1\nnot a pose\n";
/// let read = ReadTrajectory::from_lines(text.as_bytes());
/// assert_eq!(read.trajectory.poses()[0].pose.position.y, 3.0);
/// assert!(!read.report.sentences().is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadTrajectory {
    /// Poses that could be read, in order of time.
    pub trajectory: Trajectory,
    /// Report on reading the poses.
    pub report: LogReport,
}

impl ReadTrajectory {
    /// Reads a file, plain or gzipped.
    ///
    /// # Errors
    /// If there is no such file, or it holds no pose.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        let (poses, report) = log::read_records(path, "time x y z qx qy qz qw", timed)?;
        Ok(Self {
            trajectory: Trajectory::new(poses),
            report,
        })
    }

    /// Reads from `source` and returns the trajectory; other lines are left out and reported.
    pub fn from_lines(source: impl BufRead) -> Self {
        let (poses, report) = log::records(source, timed);
        Self {
            trajectory: Trajectory::new(poses),
            report,
        }
    }
}

fn timed(fields: &mut Fields<'_>) -> Result<TimedPose, Wrong> {
    let time = fields.number("the time")?;
    let [x, y] = [fields.number("x")?, fields.number("y")?];
    fields.pass(1, "z")?;
    let quaternion = [
        fields.number("qx")?,
        fields.number("qy")?,
        fields.number("qz")?,
        fields.number("qw")?,
    ];
    let pose = Pose::new(Point::new(x, y), quaternion::heading(quaternion));
    Ok(TimedPose { time, pose })
}
