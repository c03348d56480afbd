use std::io::BufRead;
use std::path::Path;

use super::{Line, LogEntry, LogError, LogReport, LogTrouble, NumberedLines, ReadScan, open};
use crate::carmen::{self, Parameters};
use crate::fields::{Fields, Wrong};
use crate::wean;

/// Reads a log of one message per line: CARMEN's and Wean Hall's, whose first words all differ.
/// Unusable lines are left out and listed in the [report](Self::report).
///
/// ```
/// use tolman_formats::{LogReader, LogEntry, LogTrouble};
/// let log = "ODOM 0 0 0 0 0 0 1.5 pippo 1.5\n\
///            FLASER 3 1.0 nan 81.9 0 0 0 0.1 0 0 2.5 pippo 2.5\n\
///            FLASER 3 1.0\n";
/// let mut reader = LogReader::new(log.as_bytes());
/// let entries: Vec<LogEntry> = reader.by_ref().collect();
/// let LogEntry::Scan(scan) = &entries[1] else { panic!() };
/// assert_eq!(scan.scan.ranges, [1.0, 80.0, 80.0]);
/// assert_eq!((scan.time, scan.odometry.position.x), (2.5, 0.1));
/// assert_eq!(reader.report().count(LogTrouble::Cut), 1);
/// ```
#[derive(Debug)]
pub struct LogReader<R> {
    lines: NumberedLines<R>,
    parameters: Parameters,
    report: LogReport,
    /// Last time of the odometry and of the laser, s. In some logs each has its own clock.
    times: [Option<f64>; 2],
}

/// Step of the clock above which it is a jump, s.
const JUMP_S: f64 = 60.0;

impl LogReader<Box<dyn BufRead + Send>> {
    /// Opens a file, plain or packed, of which `most` bytes of text may be read, as a
    /// rule [`MOST_BYTES`](crate::input::MOST_BYTES). If there are more, the report has
    /// [`LogTrouble::TooLarge`].
    ///
    /// # Errors
    /// If there is no such file.
    pub fn open(path: &Path, most: u64) -> Result<Self, LogError> {
        Ok(Self::new(open(path, most)?))
    }
}

impl<R: BufRead> LogReader<R> {
    /// Reads from `source`.
    pub fn new(source: R) -> Self {
        Self {
            lines: NumberedLines::new(source),
            parameters: Parameters::default(),
            report: LogReport::default(),
            times: [None; 2],
        }
    }

    /// Returns the report on the log as far as it was read.
    pub const fn report(&self) -> &LogReport {
        &self.report
    }

    /// Returns the entry of one line, or `None` if it has none.
    fn entry(
        parameters: &mut Parameters,
        report: &mut LogReport,
        line: u64,
        text: &str,
    ) -> Result<Option<LogEntry>, Wrong> {
        let mut fields = Fields::of(text);
        let Ok(kind) = fields.word("") else {
            return Ok(None);
        };
        let entry = match kind {
            "PARAM" => {
                parameters.take(&mut fields);
                return Ok(None);
            }
            "ODOM" => LogEntry::Odometry(carmen::odometry(line, &mut fields)?),
            "FLASER" => {
                let read = carmen::front_laser(line, &mut fields, parameters)?;
                Self::scan(report, read)
            }
            "ROBOTLASER1" => Self::scan(report, carmen::robot_laser(line, &mut fields)?),
            "RAWLASER1" => {
                let read = carmen::raw_laser(line, &mut fields, parameters)?;
                match Self::scan(report, read) {
                    LogEntry::Scan(scan) => LogEntry::BareScan(scan),
                    other => other,
                }
            }
            "O" => LogEntry::Odometry(wean::odometry(line, &mut fields)?),
            "L" => Self::scan(report, wean::laser(line, &mut fields, parameters)?),
            _ if kind.starts_with('#') => return Ok(None),
            _ => {
                report.met_other_kind(kind, line);
                return Ok(None);
            }
        };
        report.met_kind(kind, line);
        // The host and the logger's time are missing in some logs.
        if fields.left() > 2 {
            let more = format!("{} more", fields.left() - 2);
            report.met_trouble(LogTrouble::TooManyFields, line, more);
        }
        Ok(Some(entry))
    }

    fn scan(report: &mut LogReport, read: ReadScan) -> LogEntry {
        let ReadScan { scan, bad_ranges } = read;
        if bad_ranges > 0 {
            let beams = scan.scan.ranges.len();
            let what = format!("{bad_ranges} of {beams}");
            report.met_trouble(LogTrouble::NoRange, scan.line, what);
        }
        let most = scan.scan.ring.max_range;
        let is_empty = scan.scan.ranges.iter().all(|range| *range >= most);
        report.empty_scans += u64::from(is_empty);
        LogEntry::Scan(scan)
    }

    /// Counts an entry in the report, and checks its time.
    fn count(&mut self, entry: &LogEntry) {
        let (line, time, last) = match entry {
            LogEntry::Odometry(odometry) => {
                self.report.odometry += 1;
                (odometry.line, odometry.time, &mut self.times[0])
            }
            LogEntry::Scan(scan) | LogEntry::BareScan(scan) => {
                self.report.scans += 1;
                (scan.line, scan.time, &mut self.times[1])
            }
        };
        let before = last.replace(time);
        let step = before.map_or(0.0, |before| time - before);
        let trouble = match step {
            _ if step.abs() > JUMP_S => Some(LogTrouble::ClockJump),
            _ if step < 0.0 => Some(LogTrouble::BackInTime),
            _ => None,
        };
        if let Some(trouble) = trouble {
            let what = format!("by {step:.3} s");
            self.report.met_trouble(trouble, line, what);
        }
    }
}

impl<R: BufRead> Iterator for LogReader<R> {
    type Item = LogEntry;

    fn next(&mut self) -> Option<LogEntry> {
        loop {
            let (number, line) = self.lines.next_line()?;
            self.report.lines = number;
            let report = &mut self.report;
            let (trouble, what) = match line {
                Line::Text(text) => match Self::entry(&mut self.parameters, report, number, text) {
                    Ok(None) => continue,
                    Ok(Some(entry)) => {
                        self.count(&entry);
                        return Some(entry);
                    }
                    Err(wrong) => wrong,
                },
                line => line.trouble(),
            };
            report.met_trouble(trouble, number, what);
        }
    }
}
