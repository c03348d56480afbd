use thiserror::Error;

/// A line of a pose graph's file that was left out.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {kind}")]
pub struct G2oFault {
    /// Number of the line, from 1.
    pub line: usize,
    /// Kind of the line's fault.
    pub kind: G2oFaultKind,
}

/// Reason why a line of a pose graph's file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum G2oFaultKind {
    /// The line's first word is not one that the reader knows.
    #[error(
        "`{word}` is not read; only VERTEX_SE2, EDGE_SE2, FIX, TORO's VERTEX2 and EDGE2, and planar VERTEX_SE3:QUAT and EDGE_SE3:QUAT are"
    )]
    Unknown {
        /// First word of the line.
        word: String,
    },
    /// The line has too few numbers, or too many.
    #[error("{word} has {found} numbers; expected {expected}{}", if *found + 6 == *expected { ": the information matrix is missing; add the inverse of the covariance, as `100 0 0 100 0 400` for 0.1 m and 0.05 rad" } else { "" })]
    Count {
        /// First word of the line.
        word: &'static str,
        /// Number of numbers found.
        found: usize,
        /// Number of numbers expected.
        expected: usize,
    },
    /// A number is not a finite number.
    #[error("`{text}` is not a finite number; {}", if text.contains(',') { "write decimal points, not commas" } else { "measure the line again or remove it" })]
    Number {
        /// Text found in place of the number.
        text: String,
    },
    /// An id is not a whole number.
    #[error("`{text}` is not the id of a pose; ids are whole numbers from 0")]
    Id {
        /// Text found in place of the id.
        text: String,
    },
    /// A pose is given twice.
    #[error("pose {id} is given a second time, first in line {first}; remove one")]
    Twice {
        /// Id of the pose.
        id: u64,
        /// Number of the line that gives the pose first.
        first: usize,
    },
    /// The file does not contain a pose that the line names.
    #[error("it needs pose {id}, which has no VERTEX_SE2; add it")]
    NoPose {
        /// Id of the missing pose.
        id: u64,
    },
    /// An edge joins a pose with itself.
    #[error("the edge joins pose {id} with itself; remove it")]
    Loop {
        /// Id of the pose.
        id: u64,
    },
    /// A pose or an edge in space does not lie in the plane.
    #[error("it does not lie in the plane: {why}; give a graph of a robot on a level floor")]
    NotPlanar {
        /// What leaves the plane.
        why: &'static str,
    },
    /// The information matrix is not positive definite.
    #[error("the information matrix is not positive definite; give the inverse of a covariance")]
    Information,
    /// The file ends in the middle of a line.
    #[error("the file is cut off here; the part before is used")]
    Cut,
}
