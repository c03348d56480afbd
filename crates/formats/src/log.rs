//! Holds the contents of a robot's log, from any program, and a report on its faults.

mod entry;
mod lines;
mod options;
mod reader;
mod records;
mod report;
mod source;
mod tidy;
mod whole;

pub use crate::bag::LogTopic;
pub(crate) use entry::ReadScan;
pub use entry::{LogEntry, LogOdometry, LogScan, LogVelocity};
pub(crate) use lines::{Line, NumberedLines};
pub use options::{LogOptions, LogTimes};
pub use reader::LogReader;
pub(crate) use records::{read_records, records};
pub use report::{KindCount, LogReport, LogTrouble, TroubleCount};
pub use source::LogError;
pub(crate) use source::open;
pub(crate) use tidy::{Bridged, bridged, tell_jumps};
pub use whole::WholeLog;
