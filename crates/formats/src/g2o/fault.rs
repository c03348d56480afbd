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
    #[error("`{word}` is not read; only VERTEX_SE2, EDGE_SE2 and FIX are")]
    Unknown {
        /// First word of the line.
        word: String,
    },
    /// The line has too few numbers, or too many.
    #[error("{word} has {found} numbers; expected {expected}")]
    Count {
        /// The first word.
        word: &'static str,
        /// Number found.
        found: usize,
        /// Number expected.
        expected: usize,
    },
    /// A number is invalid, NaN or infinite.
    #[error("`{text}` is not a finite number; measure the line again or remove it")]
    Number {
        /// Text found.
        text: String,
    },
    /// An id is not a whole number.
    #[error("`{text}` is not the id of a pose; ids are whole numbers from 0")]
    Id {
        /// Text found.
        text: String,
    },
    /// A pose is given twice.
    #[error("pose {id} is given a second time, first in line {first}; remove one")]
    Twice {
        /// The pose.
        id: u64,
        /// The line in which it stood first.
        first: usize,
    },
    /// There is no such pose.
    #[error("it needs pose {id}, which has no VERTEX_SE2; add it")]
    NoPose {
        /// The pose.
        id: u64,
    },
    /// An edge joins a pose with itself.
    #[error("the edge joins pose {id} with itself; remove it")]
    Loop {
        /// The pose.
        id: u64,
    },
    /// An information matrix is that of no measurement.
    #[error("the information matrix is not positive definite; give the inverse of a covariance")]
    Information,
    /// The file ends in the middle of a line.
    #[error("the file is cut off here; the part before is used")]
    Cut,
}
