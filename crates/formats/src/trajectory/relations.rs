use std::io::BufRead;
use std::path::Path;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::PoseRelation;

use crate::fields::{Fields, Wrong};
use crate::log::{self, Line, LogError, LogReport, LogTrouble, NumberedLines};

/// Relative poses that were verified by hand, as the benchmark of Freiburg has them: one a line, of two times and what is between them, as
/// `from to x y z roll pitch yaw`.
///
/// ```
/// use tolman_formats::ReadRelations;
/// let read = ReadRelations::from_lines("1.0 2.5 0.3 0.1 0 0 0 1.5\n".as_bytes());
/// assert_eq!(read.relations[0].to, 2.5);
/// assert_eq!(read.relations[0].seen.heading.radians(), 1.5);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadRelations {
    /// The relations.
    pub relations: Vec<PoseRelation>,
    /// How they were read.
    pub report: LogReport,
}

impl ReadRelations {
    /// Reads a file, plain or packed by gzip.
    ///
    /// # Errors
    /// If there is no such file, or it holds no relation.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        let read = Self::from_lines(log::open(path)?);
        let what = "no line of `from to x y z roll pitch yaw`";
        if read.relations.is_empty() {
            return Err(read.report.nothing(path, what));
        }
        Ok(read)
    }

    /// Reads from `source`; what is no relation is left out and reported.
    pub fn from_lines(source: impl BufRead) -> Self {
        let mut read = Self::default();
        let mut lines = NumberedLines::new(source);
        while let Some((number, line)) = lines.next_line() {
            read.report.lines = number;
            match content(&line).and_then(|text| text.map(relation).transpose()) {
                Ok(relation) => read.relations.extend(relation),
                Err((trouble, what)) => read.report.met_trouble(trouble, number, what),
            }
        }
        read
    }
}

/// The text of a line that is neither empty nor a comment.
pub(super) fn content<'a>(line: &Line<'a>) -> Result<Option<&'a str>, Wrong> {
    match line {
        Line::Text(text) => Ok((!text.is_empty() && !text.starts_with('#')).then_some(*text)),
        Line::NoText => Err((LogTrouble::NoText, String::new())),
        Line::TooLong => Err((LogTrouble::TooLong, String::new())),
        Line::Lost(kind) => Err((LogTrouble::EndsEarly, kind.to_string())),
    }
}

fn relation(text: &str) -> Result<PoseRelation, Wrong> {
    let mut fields = Fields::of(text);
    let from = fields.number("the first time")?;
    let to = fields.number("the second time")?;
    let [x, y] = [fields.number("x")?, fields.number("y")?];
    fields.pass(3, "z, roll or pitch")?;
    let yaw = fields.number("yaw")?;
    let seen = Pose::new(Point::new(x, y), Heading::from_radians(yaw));
    Ok(PoseRelation { from, to, seen })
}
