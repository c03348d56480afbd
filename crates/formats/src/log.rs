//! What a log of a robot holds, whichever program wrote it, and what was wrong with it.

mod entry;
mod lines;
mod report;
mod source;

pub use entry::{LogEntry, LogOdometry, LogScan};
pub(crate) use lines::{Line, NumberedLines};
pub use report::{KindCount, LogReport, LogTrouble, TroubleCount};
pub use source::LogError;
pub(crate) use source::open;
