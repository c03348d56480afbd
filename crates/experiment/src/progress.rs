//! Messages of the runner to its caller while it works.

use core::time::Duration;
use std::path::Path;

/// An event that the caller may want to show.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum ProgressEvent<'a> {
    /// The folder held results of another configuration, which were moved.
    SetAside {
        /// Path of the folder of results.
        folder: &'a Path,
        /// Path of the folder to which the old results were moved.
        moved_to: &'a Path,
        /// The difference, in words.
        reason: &'a str,
    },
    /// A line of a file of runs cannot be used.
    BrokenLine {
        /// Path of the file.
        file: &'a Path,
        /// Number of the line, from 1.
        line: u64,
        /// The fault, in words.
        what: &'a str,
        /// Consequence for the run on that line.
        remedy: Remedy,
    },
    /// The experiment leaves something out.
    Skipped {
        /// The missing data, and how to get them.
        what: &'a str,
    },
    /// The runs begin.
    Started {
        /// Number of runs of the whole experiment.
        total: u64,
        /// Number of runs that are reused.
        reused: u64,
    },
    /// One more run was played.
    RunFinished,
    /// All runs were played.
    RunsFinished {
        /// Number of runs that were played now.
        played: u64,
        /// Time that the runs took.
        elapsed: Duration,
    },
    /// The first runs of each row are played again, to record replays for the report.
    Recording,
}

/// Consequence for the run of a line that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// The run is played again.
    PlayedAgain,
    /// The run is known from another line, or was not asked for.
    Ignored,
    /// The line does not name its run. Any missing runs are played.
    MissingPlayed,
}

/// Receiver of the runner's messages; the runner itself prints nothing.
pub trait Progress: Sync {
    /// Receives an event. It may be called from several threads at once.
    fn event(&self, event: &ProgressEvent<'_>);

    /// Returns whether the caller wants to stop, as after Ctrl-C. It is asked before every run.
    /// Runs in progress are finished and kept.
    fn stop_requested(&self) -> bool {
        false
    }
}

/// Progress that is not shown.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn event(&self, _event: &ProgressEvent<'_>) {}
}
