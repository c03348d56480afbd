use std::io::BufRead;
use std::path::Path;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::PoseRelation;

use crate::fields::{Fields, Wrong};
use crate::log::{self, LogError, LogReport};

/// Relative poses that were verified by hand, in the form of the benchmark of Freiburg. Each line
/// has two times and the pose between them: `from to x y z roll pitch yaw`.
///
/// ```
/// use tolman_formats::ReadRelations;
/// let read = ReadRelations::from_lines("1.0 2.5 0.3 0.1 0 0 0 1.5\n".as_bytes());
/// assert_eq!(read.relations[0].to, 2.5);
/// assert_eq!(read.relations[0].seen.heading.radians(), 1.5);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadRelations {
    /// Relations that could be read, in the order of the file.
    pub relations: Vec<PoseRelation>,
    /// Report on reading the relations.
    pub report: LogReport,
}

impl ReadRelations {
    /// Reads a file, plain or gzipped.
    ///
    /// # Errors
    /// If there is no such file, or it holds no relation.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        let what = "from to x y z roll pitch yaw";
        let (relations, report) = log::read_records(path, what, relation)?;
        Ok(Self { relations, report })
    }

    /// Reads from `source` and returns the relations; other lines are left out and reported.
    pub fn from_lines(source: impl BufRead) -> Self {
        let (relations, report) = log::records(source, relation);
        Self { relations, report }
    }
}

fn relation(fields: &mut Fields<'_>) -> Result<PoseRelation, Wrong> {
    let from = fields.number("the first time")?;
    let to = fields.number("the second time")?;
    let [x, y] = [fields.number("x")?, fields.number("y")?];
    fields.pass(3, "z, roll or pitch")?;
    let yaw = fields.number("yaw")?;
    let seen = Pose::new(Point::new(x, y), Heading::from_radians(yaw));
    Ok(PoseRelation { from, to, seen })
}
