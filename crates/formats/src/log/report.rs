use alloc::collections::BTreeMap;
use core::fmt;
use std::path::Path;

use super::{LogError, LogTopic};

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
    /// Lines that were used, by their first word.
    pub kinds: BTreeMap<String, KindCount>,
    /// Choices that were made for the whole log, one sentence each.
    pub notes: Vec<String>,
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
    /// A range is negative, zero, below the laser's least range or not a number. The beam says
    /// nothing; the scan is used.
    NoRange,
    /// The line's time is earlier than that of the line above. It is used.
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
    /// The laser stands on its edge, so its scan is no plan of the floor. Left out.
    OnEdge,
    /// The laser's greatest range is not given. It is taken to be the greatest that was measured.
    NoMaxRange,
    /// The line has more fields than expected. It is used without them.
    TooManyFields,
}

/// Maximum number of kinds of lines that are distinguished.
const MOST_KINDS: usize = 50;
/// Maximum number of lines listed for each kind of trouble.
const NAMED: usize = 5;
/// Maximum length of a word in the report, characters; longer words are cut.
const LONGEST_WORD: usize = 60;

impl LogReport {
    /// Counts a line that is used.
    pub(crate) fn met_kind(&mut self, kind: &str, line: u64) {
        add(&mut self.kinds, kind, line, 1);
    }

    /// Counts a line that is not used.
    pub(crate) fn met_other_kind(&mut self, kind: &str, line: u64) {
        self.met_other_kinds(kind, line, 1);
    }

    pub(crate) fn met_other_kinds(&mut self, kind: &str, first_line: u64, count: u64) {
        add(&mut self.other_kinds, kind, first_line, count);
    }

    /// Returns all kinds of lines, in the order of their first.
    pub(crate) fn kinds(&self) -> Vec<LogTopic> {
        let all = self.kinds.iter().chain(&self.other_kinds);
        let mut all: Vec<LogTopic> = all
            .map(|(kind, met)| LogTopic::of_lines(kind, *met))
            .collect();
        all.sort_by_key(|kind| kind.first);
        all
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
        told.extend(self.notes.iter().cloned());
        told.extend(self.other_kinds.iter().map(|(kind, met)| {
            let KindCount { count, first_line } = met;
            format!("{kind}: {count} × not used, first in line {first_line}")
        }));
        let troubles = self.troubles.iter();
        told.extend(troubles.map(|(trouble, met)| format!("{trouble}: {met}")));
        told
    }
}

fn add(kinds: &mut BTreeMap<String, KindCount>, kind: &str, first_line: u64, count: u64) {
    let kind: String = kind
        .chars()
        .filter(|letter| !letter.is_control())
        .take(LONGEST_WORD)
        .collect();
    let is_known = kinds.contains_key(&kind) || kinds.len() < MOST_KINDS;
    let kind = if is_known { kind } else { "…".to_owned() };
    let first = KindCount {
        count: 0,
        first_line,
    };
    kinds.entry(kind).or_insert(first).count += count;
}

impl fmt::Display for LogTrouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cut => "cut lines, left out",
            Self::NoNumber => "fields that are not finite numbers, their lines left out",
            Self::NoText => "lines that are not text, left out",
            Self::TooLong => "lines longer than a megabyte, left out",
            Self::NoRange => "ranges that are no lengths or below the least, which say nothing",
            Self::BackInTime => "times before those of the line above, used",
            Self::ClockJump => "jumps of the clock by more than a minute, used",
            Self::EndsEarly => "the file cannot be read to its end; the lines before are used",
            Self::TooLarge => "the file holds more text than may be read",
            Self::UnknownKind => "lines of a kind that is not known, left out",
            Self::NoOdometry => "scans of times without odometry, left out",
            Self::NoMount => {
                "scans of lasers whose position is unknown, assumed to be the robot's middle"
            }
            Self::OnEdge => "scans of lasers that stand on their edge, left out",
            Self::NoMaxRange => {
                "scans without a greatest range, taken to be the greatest that was measured"
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
