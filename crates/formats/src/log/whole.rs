use std::io::{self, BufReader, Cursor, Read, Seek};
use std::path::Path;

use super::source::text;
use super::tidy::{Bridged, bridged, tell_jumps, tidy};
use super::{LogEntry, LogError, LogOptions, LogReader, LogReport, LogScan, LogTopic, LogTrouble};
use crate::bag::{self, Bag, BagKind};
use crate::input;
use crate::unpack::{Unpacked, unpacked};
use tolman_robot::{TimedPose, Trajectory};

/// A robot's log, read whole: its scans in the order of time, each with the robot's pose by
/// odometry.
///
/// It may be a log of lines, a bag of ROS 1 or 2, or a folder of bags; plain or packed by gzip,
/// bzip2, xz or zstd. If it has no odometry, all of its poses are the same.
///
/// ```
/// use tolman_formats::{LogOptions, WholeLog};
/// let lines = "FLASER 2 1.0 2.0 0 0 0 0 0 0 2.5 h 2.5\nFLASER 2 1.1 2.1 0 0 0 0 0 0 1.5 h 1.5\n";
/// let log = WholeLog::of_bytes(lines.as_bytes().to_vec(), &LogOptions::whole()).unwrap();
/// let times: Vec<f64> = log.scans.iter().map(|scan| scan.time).collect();
/// assert_eq!(times, [1.5, 2.5]);
/// assert!(log.report.notes[0].contains("sorted"));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WholeLog {
    /// Scans that can be used.
    pub scans: Vec<LogScan>,
    /// Report on reading the log.
    pub report: LogReport,
}

/// An open log.
enum Source {
    Lines(Unpacked),
    Bag(Box<Bag>),
}

impl WholeLog {
    /// Reads a file or a folder.
    ///
    /// # Errors
    /// If it cannot be read, or no scan of it can be used.
    pub fn open(path: &Path, options: &LogOptions) -> Result<Self, LogError> {
        let log = match open(path, options.most)? {
            Source::Lines(lines) => Ok(of_lines(lines, options.most)),
            Source::Bag(bag) => bag.finish(options),
        };
        let nothing = |what| LogError::Nothing {
            path: path.to_owned(),
            what,
        };
        let (scans, report) = log.map_err(nothing)?;
        if report.count(LogTrouble::TooLarge) > 0 {
            let most = options.most >> 20;
            return Err(nothing(format!(
                "it holds more than {most} MiB; give it in parts, or raise this by --most-mib"
            )));
        }
        if scans.is_empty() {
            let told = report.sentences().join("; ");
            return Err(nothing(format!(
                "no scan can be used; give a log of CARMEN with FLASER, ROBOTLASER1 or RAWLASER1 lines, one of Wean Hall, or a bag of ROS ({told})"
            )));
        }
        Ok(Self::tidied(scans, report))
    }

    /// Reads a log in memory.
    ///
    /// # Errors
    /// In words, if it is a bag without what the options name.
    pub fn of_bytes(bytes: Vec<u8>, options: &LogOptions) -> Result<Self, String> {
        let most = options.most;
        let mut bag = Bag::new(most);
        let lines = lines_of(Cursor::new(bytes), most, "", &mut bag);
        let (scans, report) = match lines.map_err(|error| error.to_string())? {
            Some(lines) => of_lines(lines, most),
            None => bag.finish(options)?,
        };
        Ok(Self::tidied(scans, report))
    }

    /// Returns what a log holds: the topics of a bag, or the kinds of lines.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn list(path: &Path, most: u64) -> Result<Vec<LogTopic>, LogError> {
        match open(path, most)? {
            Source::Bag(bag) => Ok(bag.list()),
            Source::Lines(lines) => {
                let mut reader = LogReader::new(text(lines, most));
                reader.by_ref().for_each(drop);
                Ok(reader.report().kinds())
            }
        }
    }

    fn tidied(mut scans: Vec<LogScan>, mut report: LogReport) -> Self {
        tidy(&mut scans, &mut report);
        Self { scans, report }
    }
}

fn open(path: &Path, most: u64) -> Result<Source, LogError> {
    let wrong = |source| LogError::File {
        path: path.to_owned(),
        source,
    };
    let nothing = |what: String| LogError::Nothing {
        path: path.to_owned(),
        what,
    };
    if !path.is_dir() {
        let mut bag = Box::new(Bag::new(most));
        let lines = lines_of_file(path, most, "", &mut bag).map_err(wrong)?;
        return Ok(lines.map_or(Source::Bag(bag), Source::Lines));
    }
    let (files, packed) = bag::files(path).map_err(wrong)?;
    let mut whole = Box::new(Bag::new(most));
    for file in &files {
        let lines = lines_of_file(file, most, &packed, &mut whole);
        let lines = lines.map_err(|source| LogError::File {
            path: file.clone(),
            source,
        })?;
        if lines.is_some() {
            return Err(nothing(format!("{} is no bag", file.display())));
        }
    }
    match files.is_empty() {
        true => Err(nothing(
            "it is a folder without bags; give a file, or the folder of a bag".to_owned(),
        )),
        false => Ok(Source::Bag(whole)),
    }
}

/// Takes in a file if it is a bag; else returns its lines.
fn lines_of_file(
    path: &Path,
    most: u64,
    packed: &str,
    bag: &mut Bag,
) -> io::Result<Option<Unpacked>> {
    let mut file = input::open(path)?;
    if file.metadata()?.is_file() {
        // Pages of a plain database are read where they lie.
        let mut first = Vec::new();
        file.by_ref().take(FIRST_BYTES).read_to_end(&mut first)?;
        file.rewind()?;
        if BagKind::of(&first) == Some(BagKind::Sqlite) {
            bag.take_database(BufReader::new(file), packed);
            return Ok(None);
        }
    }
    lines_of(file, most, packed, bag)
}

/// Takes in a source if it is a bag; else returns its lines.
fn lines_of(
    source: impl Read + Send + 'static,
    most: u64,
    packed: &str,
    bag: &mut Bag,
) -> io::Result<Option<Unpacked>> {
    let (first, whole) = unpacked(source)?;
    match BagKind::of(&first) {
        None => return Ok(Some(whole)),
        Some(BagKind::Sqlite) => {
            let mut bytes = Vec::new();
            // A file that is cut is used as far as it goes.
            let _ = whole.take(most).read_to_end(&mut bytes);
            bag.take_database(Cursor::new(bytes), packed);
        }
        Some(kind) => bag.take_stream(kind, whole),
    }
    Ok(None)
}

/// Number of bytes by which a kind of bag is known.
const FIRST_BYTES: u64 = 16;

/// Reads a log of lines.
fn of_lines(lines: Unpacked, most: u64) -> (Vec<LogScan>, LogReport) {
    let mut reader = LogReader::new(text(lines, most));
    let (mut scans, mut bare, mut moved) = (Vec::new(), Vec::new(), Vec::new());
    for entry in reader.by_ref() {
        match entry {
            LogEntry::Scan(scan) => scans.push(scan),
            LogEntry::BareScan(scan) => bare.push(scan),
            LogEntry::Odometry(odometry) => moved.push(TimedPose {
                time: odometry.time,
                pose: odometry.pose,
            }),
        }
    }
    let mut report = reader.report().clone();
    if !scans.is_empty() {
        return (scans, report);
    }
    // A log of a laser by itself: where the robot was is between two lines of odometry.
    let Bridged { poses, jumps } = bridged(Trajectory::new(moved).poses());
    tell_jumps(&mut report, "the odometry of ODOM", &jumps);
    let way = Trajectory::new(poses);
    for mut scan in bare {
        let at = match way.poses().is_empty() {
            true => Some(scan.odometry),
            false => way.at(scan.time),
        };
        match at {
            Some(pose) => {
                scan.odometry = pose;
                scan.noted = pose.compose(scan.robot_from_laser);
                scans.push(scan);
            }
            None => {
                let what = format!("at {:.3} s", scan.time);
                report.met_trouble(LogTrouble::NoOdometry, scan.line, what);
            }
        }
    }
    (scans, report)
}
