use std::path::Path;

use thiserror::Error;
use tolman_geom::nalgebra::{
    Isometry3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3,
};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{TimedPose, Trajectory};

use crate::input::{self, MOST_BYTES, SourceError};
use crate::log::open;

/// A trajectory in space, read from a file. Every line has to be right: a score of half a file
/// means nothing.
///
/// | format | a line |
/// | --- | --- |
/// | TUM | `time x y z qx qy qz qw` |
/// | EuRoC | `time,x,y,z,qw,qx,qy,qz`, the time in ns; further columns are ignored |
/// | KITTI | the first three rows of a matrix, 12 numbers; no time |
///
/// ```
/// use tolman_formats::ReadTrajectory;
/// let read = ReadTrajectory::parse("# time x y z qx qy qz qw\n1.0 2.0 3.0 0 0 0 0 1\n")?;
/// assert_eq!(read.poses[0].pose.translation.y, 3.0);
/// let wrong = ReadTrajectory::parse("1,5 2,0 3,0 0 0 0 0 1\n").unwrap_err();
/// assert!(wrong.to_string().starts_with("line 1: `1,5`"));
/// # Ok::<(), tolman_formats::TrajectoryError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ReadTrajectory {
    /// Poses, in the order of time.
    pub poses: Vec<SpacePose>,
    /// Whether the poses have times. If not, their numbers stand for them.
    pub is_timed: bool,
}

/// A pose in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpacePose {
    /// Time of the pose, s.
    pub time: f64,
    /// Pose at that time.
    pub pose: Isometry3<f64>,
}

/// Reason why a trajectory cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TrajectoryError {
    /// The file cannot be read, or is not text.
    #[error("it cannot be read")]
    Source(#[from] SourceError),
    /// A line has another number of columns than the format.
    #[error(
        "line {line}: {found} columns; TUM has 8, `time x y z qx qy qz qw`, KITTI 12, and EuRoC at least 8 with commas between"
    )]
    Columns {
        /// Number of the line, from 1.
        line: usize,
        /// Number of its columns.
        found: usize,
    },
    /// A column is not a finite number.
    #[error("line {line}: `{text}` is not a finite number{}", if text.contains(',') { "; write decimal points" } else { "" })]
    Number {
        /// Number of the line, from 1.
        line: usize,
        /// The column.
        text: String,
    },
    /// An orientation is no rotation.
    #[error("line {line}: the orientation is no rotation")]
    Orientation {
        /// Number of the line, from 1.
        line: usize,
    },
    /// Two poses have the same time.
    #[error("line {line}: time {time} is given a second time; write times with all their digits")]
    Twice {
        /// Number of the line, from 1.
        line: usize,
        /// The time, s.
        time: f64,
    },
    /// There is no pose.
    #[error("it has no pose; give lines of `time x y z qx qy qz qw`")]
    Empty,
}

/// Format of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LineFormat {
    Tum,
    Euroc,
    Kitti,
}

impl ReadTrajectory {
    /// Reads a file, plain or packed.
    ///
    /// # Errors
    /// [`TrajectoryError`], of the first line that is wrong.
    pub fn open(path: &Path) -> Result<Self, TrajectoryError> {
        let source = open(path, MOST_BYTES)
            .map_err(|error| SourceError::System(std::io::Error::other(error)))?;
        Self::parse(&input::text_of(source)?)
    }

    /// Reads the text of a file. O(n log n).
    ///
    /// # Errors
    /// [`TrajectoryError`], of the first line that is wrong.
    pub fn parse(text: &str) -> Result<Self, TrajectoryError> {
        let mut format = None;
        let mut poses: Vec<(usize, SpacePose)> = Vec::new();
        for (index, text) in input::without_mark(text).lines().enumerate() {
            let (line, text) = (index + 1, text.trim());
            if text.is_empty() || text.starts_with('#') {
                continue;
            }
            let columns: Vec<&str> = text.split_ascii_whitespace().collect();
            let by_comma: Vec<&str> = text.split(',').map(str::trim).collect();
            let found = match (columns.len(), by_comma.len()) {
                (8, _) => LineFormat::Tum,
                (12, _) => LineFormat::Kitti,
                (1, 8..) => LineFormat::Euroc,
                (1, found) | (found, _) => return Err(TrajectoryError::Columns { line, found }),
            };
            if *format.get_or_insert(found) != found {
                let found = columns.len();
                return Err(TrajectoryError::Columns { line, found });
            }
            let columns = if found == LineFormat::Euroc {
                by_comma
            } else {
                columns
            };
            let pose = match found {
                LineFormat::Tum => tum(line, &numbers(line, &columns)?)?,
                LineFormat::Euroc => euroc(line, &numbers(line, &columns)?)?,
                LineFormat::Kitti => kitti(line, poses.len(), &numbers(line, &columns)?)?,
            };
            poses.push((line, pose));
        }
        poses.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time));
        let mut pairs = poses.iter().zip(poses.iter().skip(1));
        if let Some((_, (line, pose))) = pairs.find(|((_, a), (_, b))| a.time >= b.time) {
            let (line, time) = (*line, pose.time);
            return Err(TrajectoryError::Twice { line, time });
        }
        let format = format.ok_or(TrajectoryError::Empty)?;
        Ok(Self {
            poses: poses.into_iter().map(|(_, pose)| pose).collect(),
            is_timed: format != LineFormat::Kitti,
        })
    }

    /// Returns the trajectory on the floor: positions x and y, and where each x axis points.
    #[must_use]
    pub fn planar(&self) -> Trajectory {
        let poses = self.poses.iter().map(|SpacePose { time, pose }| {
            let ahead = pose.rotation * Vector3::x();
            let heading = Heading::from_radians(libm::atan2(ahead.y, ahead.x));
            let at = pose.translation.vector;
            TimedPose {
                time: *time,
                pose: Pose::new(Point::new(at.x, at.y), heading),
            }
        });
        Trajectory::new(poses)
    }
}

fn numbers<const N: usize>(line: usize, columns: &[&str]) -> Result<[f64; N], TrajectoryError> {
    let mut numbers = [0.0; N];
    for (number, text) in numbers.iter_mut().zip(columns) {
        let parsed = text.parse::<f64>().ok().filter(|number| number.is_finite());
        *number = parsed.ok_or_else(|| TrajectoryError::Number {
            line,
            text: text.chars().take(24).collect(),
        })?;
    }
    Ok(numbers)
}

fn turned(line: usize, [x, y, z, w]: [f64; 4]) -> Result<UnitQuaternion<f64>, TrajectoryError> {
    let turned = Quaternion::new(w, x, y, z);
    match turned.norm() > 1e-6 {
        true => Ok(UnitQuaternion::new_normalize(turned)),
        false => Err(TrajectoryError::Orientation { line }),
    }
}

fn tum(line: usize, [time, x, y, z, q @ ..]: &[f64; 8]) -> Result<SpacePose, TrajectoryError> {
    let at = Translation3::new(*x, *y, *z);
    let pose = Isometry3::from_parts(at, turned(line, *q)?);
    Ok(SpacePose { time: *time, pose })
}

fn euroc(line: usize, numbers: &[f64; 8]) -> Result<SpacePose, TrajectoryError> {
    let [time, x, y, z, qw, qx, qy, qz] = *numbers;
    tum(line, &[1e-9 * time, x, y, z, qx, qy, qz, qw])
}

/// Greatest departure of a matrix from a rotation.
const SKEW: f64 = 1e-2;

fn kitti(line: usize, number: usize, numbers: &[f64; 12]) -> Result<SpacePose, TrajectoryError> {
    let [a, b, c, x, d, e, f, y, g, h, i, z] = *numbers;
    let matrix = tolman_geom::nalgebra::Matrix3::new(a, b, c, d, e, f, g, h, i);
    let off = matrix * matrix.transpose() - tolman_geom::nalgebra::Matrix3::identity();
    if off.abs().max() > SKEW || matrix.determinant() < 0.0 {
        return Err(TrajectoryError::Orientation { line });
    }
    let turned = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix));
    let pose = Isometry3::from_parts(Translation3::new(x, y, z), turned);
    let time = number as f64;
    Ok(SpacePose { time, pose })
}
