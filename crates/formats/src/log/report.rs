use alloc::collections::BTreeMap;
use core::fmt;
use std::path::Path;

use super::LogError;

/// Report on reading a log: its contents, and the parts that were left out.
///
/// ```
/// use tolman_formats::{LogReader, LogTrouble};
///
/// let log = "ODOM 0 0 0 0 0 0 1.5 mine 1.5\nFLASER 3 1.0\n";
/// let mut reader = LogReader::new(log.as_bytes());
/// assert_eq!(reader.by_ref().count(), 1);
/// let report = reader.report();
/// assert_eq!((report.lines, report.count(LogTrouble::Cut)), (2, 1));
/// for sentence in report.sentences() {
///     println!("{sentence}");
/// }
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogReport {
    /// Number of lines, including empty ones and comments.
    pub lines: u64,
    /// Number of lines of odometry that were used.
    pub odometry: u64,
    /// Number of scans that were used.
    pub scans: u64,
    /// Number of scans in which no beam hit anything.
    pub empty_scans: u64,
    /// Lines of other kinds, by their first word. After fifty kinds, all others are counted under
    /// `…`.
    pub other_kinds: BTreeMap<String, KindCount>,
    /// Kinds of trouble met, with the lines that had them.
    pub troubles: BTreeMap<LogTrouble, TroubleCount>,
}

/// Count of a kind of line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KindCount {
    /// Number of lines.
    pub count: u64,
    /// Number of the first such line, from 1.
    pub first_line: u64,
}

/// Count of a kind of trouble.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TroubleCount {
    /// Number of lines.
    pub count: u64,
    /// First such lines, at most five: the number of the line, from 1, and its trouble.
    pub first: Vec<(u64, String)>,
}

/// Trouble with a line of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LogTrouble {
    /// The line has too few fields. Left out.
    Cut,
    /// A field that must be a finite number is not. Left out.
    NoNumber,
    /// The line is not UTF-8 text. Left out.
    NoText,
    /// The line is longer than a megabyte. Left out.
    TooLong,
    /// A range is negative or not a number. The scan is used, as if the beam had hit nothing.
    NoRange,
    /// The line's time is earlier than that of the line above. It is used, in the order of the
    /// file.
    BackInTime,
    /// The clock jumps by more than a minute. It is used.
    ClockJump,
    /// The rest of the file cannot be read. The part before is used.
    EndsEarly,
    /// The file holds more text than may be read.
    TooLarge,
    /// The line is of an unknown kind. Left out.
    UnknownKind,
    /// A scan at a time without odometry. Left out.
    NoOdometry,
    /// The laser's position is unknown. It is assumed to be in the robot's middle.
    NoMount,
    /// The line has more fields than expected. It is used without them.
    TooManyFields,
}

/// Maximum number of kinds of lines that are distinguished.
const MOST_KINDS: usize = 50;
/// Maximum number of lines listed for each kind of trouble.
const NAMED: usize = 5;
/// Maximum length of a word in the report, characters; longer words are cut.
const LONGEST_WORD: usize = 24;

impl LogReport {
    pub(crate) fn met_other_kind(&mut self, kind: &str, line: u64) {
        let kind: String = kind.chars().take(LONGEST_WORD).collect();
        let is_known = self.other_kinds.contains_key(&kind);
        let kind = match is_known || self.other_kinds.len() < MOST_KINDS {
            true => kind,
            false => "…".to_owned(),
        };
        let first = KindCount {
            count: 0,
            first_line: line,
        };
        self.other_kinds.entry(kind).or_insert(first).count += 1;
    }

    pub(crate) fn met_trouble(&mut self, trouble: LogTrouble, line: u64, what: impl Into<String>) {
        let empty = TroubleCount {
            count: 0,
            first: Vec::new(),
        };
        let known = self.troubles.entry(trouble).or_insert(empty);
        known.count += 1;
        if known.first.len() < NAMED {
            known.first.push((line, what.into()));
        }
    }

    /// Returns the error of a file without usable contents: the expected contents, and the first
    /// fault.
    pub(crate) fn nothing(&self, path: &Path, what: &str) -> LogError {
        let first = self.troubles.iter().next();
        let first = first.map_or_else(String::new, |(trouble, met)| format!("; {trouble}: {met}"));
        LogError::Nothing {
            path: path.to_owned(),
            what: format!("it has {what} among {} lines{first}", self.lines),
        }
    }

    /// Returns the number of lines with this trouble.
    #[must_use]
    pub fn count(&self, trouble: LogTrouble) -> u64 {
        self.troubles.get(&trouble).map_or(0, |known| known.count)
    }

    /// Returns the report for readers, one sentence per line: the log's contents, and what was left
    /// out with the reasons. O(kinds).
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let Self {
            lines,
            odometry,
            scans,
            empty_scans,
            ..
        } = self;
        let mut told = vec![format!(
            "{lines} lines: {scans} scans, {odometry} lines of odometry"
        )];
        if *scans > 0 && 2 * empty_scans > *scans {
            told.push(format!(
                "{empty_scans} of {scans} scans hit nothing; are the ranges in metres?"
            ));
        }
        told.extend(self.other_kinds.iter().map(|(kind, met)| {
            let KindCount { count, first_line } = met;
            format!("{kind}: {count} × not used, first in line {first_line}")
        }));
        let troubles = self.troubles.iter();
        told.extend(troubles.map(|(trouble, met)| format!("{trouble}: {met}")));
        told
    }
}

impl fmt::Display for LogTrouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cut => "cut lines, left out",
            Self::NoNumber => "fields that are not finite numbers, their lines left out",
            Self::NoText => "lines that are not text, left out",
            Self::TooLong => "lines longer than a megabyte, left out",
            Self::NoRange => "ranges that are not numbers, taken for beams that hit nothing",
            Self::BackInTime => "times before those of the line above, used in the file's order",
            Self::ClockJump => "jumps of the clock by more than a minute, used",
            Self::EndsEarly => "the file cannot be read to its end; the lines before are used",
            Self::TooLarge => "the file holds more text than may be read",
            Self::UnknownKind => "lines of a kind that is not known, left out",
            Self::NoOdometry => "scans of times without odometry, left out",
            Self::NoMount => {
                "scans of lasers whose position is unknown, assumed to be the robot's middle"
            }
            Self::TooManyFields => {
                "lines with more fields than they should have, used without them"
            }
        })
    }
}

impl fmt::Display for TroubleCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ×", self.count)?;
        for (index, (line, what)) in self.first.iter().enumerate() {
            let joint = if index == 0 { "" } else { ";" };
            write!(f, "{joint} line {line} ({what})")?;
        }
        f.write_str(if self.count > self.first.len() as u64 {
            "; …"
        } else {
            ""
        })
    }
}
