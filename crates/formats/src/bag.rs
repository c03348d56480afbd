//! Bags of ROS: laser scans, odometry, and where the laser sits. They are MCAP or SQLite files of
//! ROS 2, files of ROS 1, or folders of such files.
//!
//! Read are `LaserScan`, `MultiEchoLaserScan`, `Odometry` and the transforms of `/tf` and
//! `/tf_static`. All else is counted.
//!
//! Sources: the interface definitions of ROS, and those named in each format's file.

mod folder;
mod frames;
mod mcap;
mod message;
mod ros1;
mod scans;
mod sqlite;
mod topics;

use std::io::{self, BufRead, Read, Seek};

use crate::log::{LogOptions, LogReport, LogTrouble};
pub(crate) use folder::files;
use message::Message;
pub use topics::LogTopic;
use topics::Topics;

/// Takes a message of a bag.
type Take<'a> = dyn FnMut(Message<'_>) -> io::Result<()> + 'a;

/// A kind of bag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BagKind {
    Mcap,
    Ros1,
    Sqlite,
}

impl BagKind {
    /// Returns the kind of bag that begins with these bytes; `None` if none does.
    pub(crate) fn of(first: &[u8]) -> Option<Self> {
        let kinds = [
            (mcap::MAGIC, Self::Mcap),
            (ros1::MAGIC, Self::Ros1),
            (sqlite::MAGIC, Self::Sqlite),
        ];
        let mut kinds = kinds.into_iter();
        let kind = kinds.find(|(magic, _)| first.starts_with(magic));
        kind.map(|(_, kind)| kind)
    }
}

/// The messages of a bag, of which those that are needed are kept.
pub(crate) struct Bag {
    report: LogReport,
    topics: Topics,
    /// Number of bytes that may still be kept.
    left: u64,
}

impl Bag {
    pub(crate) fn new(most: u64) -> Self {
        Self {
            report: LogReport::default(),
            topics: Topics::default(),
            left: most,
        }
    }

    /// Takes in all messages of a file, up to the end or to the first that cannot be read. `packed`
    /// names how each message is packed, which some folders say.
    pub(crate) fn take_stream(&mut self, kind: BagKind, source: impl BufRead) {
        let read = match kind {
            BagKind::Mcap => mcap::read(source, &mut |message| self.take(&message)),
            BagKind::Ros1 => ros1::read(source, &mut |message| self.take(&message)),
            BagKind::Sqlite => Err(io::ErrorKind::Unsupported.into()),
        };
        self.met_end(read);
    }

    /// Takes in all messages of a SQLite file.
    pub(crate) fn take_database(&mut self, source: impl Read + Seek, packed: &str) {
        let read = sqlite::read(source, packed, &mut |message| self.take(&message));
        self.met_end(read);
    }

    fn met_end(&mut self, read: io::Result<()>) {
        let Err(error) = read else { return };
        let trouble = match error.kind() {
            io::ErrorKind::FileTooLarge => LogTrouble::TooLarge,
            _ => LogTrouble::EndsEarly,
        };
        let number = self.report.lines + 1;
        self.report.met_trouble(trouble, number, error.to_string());
    }

    fn take(&mut self, message: &Message<'_>) -> io::Result<()> {
        self.report.lines += 1;
        let number = self.report.lines;
        match self.topics.take(number, message) {
            Ok(false) => {}
            Ok(true) => {
                let left = self.left.checked_sub(message.data.len() as u64);
                self.left = left.ok_or(io::ErrorKind::FileTooLarge)?;
            }
            Err(what) => self.report.met_trouble(LogTrouble::Cut, number, what),
        }
        Ok(())
    }

    /// Returns what each topic holds.
    pub(crate) fn list(&self) -> Vec<LogTopic> {
        self.topics.list()
    }

    /// Returns the scans of the chosen topics with the robot's pose by odometry, in the order of
    /// time.
    ///
    /// # Errors
    /// In words, if a chosen topic has no messages of its kind.
    pub(crate) fn finish(self, options: &LogOptions) -> Result<scans::Placed, String> {
        scans::placed(self.topics, self.report, options)
    }
}

/// Returns nanoseconds as seconds.
fn seconds(nanoseconds: i128) -> f64 {
    // Whole seconds and the rest are exact each; their sum is the nearest number.
    (nanoseconds / 1_000_000_000) as f64 + 1e-9 * (nanoseconds % 1_000_000_000) as f64
}
