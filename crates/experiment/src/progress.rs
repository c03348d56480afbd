//! Messages of the runner to its caller while it works.

use core::time::Duration;
use std::path::Path;

/// Something a caller may want to show.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum ProgressEvent<'a> {
    /// The folder held results of another configuration, which now lie elsewhere.
    SetAside {
        /// The folder of results.
        folder: &'a Path,
        /// New folder of its former contents.
        moved_to: &'a Path,
        /// What differs.
        reason: &'a str,
    },
    /// A line of a file of runs cannot be used.
    BrokenLine {
        /// The file.
        file: &'a Path,
        /// The line, from 1.
        line: u64,
        /// What is wrong with it.
        what: &'a str,
        /// What happens to its run.
        remedy: Remedy,
    },
    /// The experiment leaves something out.
    Skipped {
        /// The missing data, and how to get it.
        what: &'a str,
    },
    /// The runs begin.
    Started {
        /// Runs of the whole experiment.
        total: u64,
        /// Runs that are there from before.
        reused: u64,
    },
    /// One more run was played.
    RunFinished,
    /// All runs were played.
    RunsFinished {
        /// Runs that were played now.
        played: u64,
        /// Duration.
        elapsed: Duration,
    },
    /// The first runs of each row are played again, for the report to replay.
    Recording,
}

/// What happens to the run of a line that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// The run is played again.
    PlayedAgain,
    /// The run is there from another line, or was not asked for.
    Ignored,
    /// The line does not say which run it was; whichever runs are missing are played.
    MissingPlayed,
}

/// Receiver of the runner's messages; the runner itself prints nothing.
pub trait Progress: Sync {
    /// Hears of an event. May be called from several threads at once.
    fn event(&self, event: &ProgressEvent<'_>);

    /// Returns whether the caller wants to stop, as after Ctrl-C. Asked before every run; runs that
    /// are being played are finished and kept.
    fn stop_requested(&self) -> bool {
        false
    }
}

/// Shows nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn event(&self, _event: &ProgressEvent<'_>) {}
}
