//! Holds the contents of a robot's log, from any program, and a report on its faults.

mod entry;
mod lines;
mod reader;
mod records;
mod report;
mod source;

pub(crate) use entry::ReadScan;
pub use entry::{LogEntry, LogOdometry, LogScan, LogVelocity};
pub(crate) use lines::{Line, NumberedLines};
pub use reader::LogReader;
pub(crate) use records::{read_records, records};
pub use report::{KindCount, LogReport, LogTrouble, TroubleCount};
pub(crate) use source::open;
pub use source::{LogError, is_mcap};
