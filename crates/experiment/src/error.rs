//! Errors of running an experiment.

use std::io;
use std::path::PathBuf;

use super::{BoxError, Job, choices};

/// Reason why an experiment could not be completed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// There is no experiment, table or row of that name.
    #[error("there is no {what} named {name:?}; {choices}")]
    Unknown {
        /// `experiment`, `table` or `row`.
        what: &'static str,
        /// Name that was asked for.
        name: String,
        /// Name that was probably meant, and all names that exist.
        choices: String,
    },
    /// Input of the experiment cannot be read.
    #[error("experiment {name} cannot be prepared; correct its options or its input")]
    Open {
        /// Name of the experiment.
        name: String,
        /// Reason why the input cannot be read.
        source: BoxError,
    },
    /// A number of runs or jobs is zero.
    #[error("{option} is 0, so nothing would be run; give it 1 or more")]
    Zero {
        /// Name of the option.
        option: &'static str,
    },
    /// A table has a fixed number of runs.
    #[error("table {table:?} always has {own} runs per row; leave --runs out")]
    FixedRuns {
        /// Name of the table.
        table: String,
        /// Fixed number of runs of each row.
        own: u32,
    },
    /// A table that the options name would have no runs.
    #[error("table {table:?} would have no runs; give a greater number with --runs")]
    EmptyTable {
        /// Name of the table.
        table: String,
    },
    /// More runs are asked for than fit into memory.
    #[error("{runs} runs of each row are too many; give --runs {most} or fewer")]
    TooManyRuns {
        /// Number of runs asked for.
        runs: u32,
        /// Maximum number of runs.
        most: u32,
    },
    /// The master seed is too large for TOML's integers.
    #[error("seed {seed} is too large for config.toml; give one below 2^63")]
    Seed {
        /// Seed that was given.
        seed: u64,
    },
    /// The experiment's tables are inconsistent.
    #[error("the tables of experiment {name} are invalid: {what}")]
    Tables {
        /// Name of the experiment.
        name: String,
        /// The fault, in words.
        what: String,
    },
    /// The folder of results holds something else.
    #[error(
        "{} holds files but no results of tolman ({what}); choose another folder with --out or \
         empty this one",
        folder.display()
    )]
    ForeignFolder {
        /// Path of the folder.
        folder: PathBuf,
        /// Contents found there, in words.
        what: String,
    },
    /// Another process is using the folder of results.
    #[error(
        "another experiment is writing to {}; wait for it or choose another folder with --out",
        folder.display()
    )]
    Busy {
        /// Path of the folder.
        folder: PathBuf,
    },
    /// A file or folder cannot be read or written.
    #[error("cannot {action} {}; {repair}", path.display())]
    File {
        /// Action that failed, as a verb phrase.
        action: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// Advice on the repair.
        repair: &'static str,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The configuration cannot be written as TOML.
    #[error("the configuration of experiment {name} cannot be written as TOML")]
    Config {
        /// Name of the experiment.
        name: String,
        /// Error of the TOML writer.
        source: toml::ser::Error,
    },
    /// The summary cannot be written as JSON.
    #[error("the summary of experiment {name} cannot be written as JSON")]
    Summary {
        /// Name of the experiment.
        name: String,
        /// Error of the JSON writer.
        source: serde_json::Error,
    },
    /// The threads cannot be started.
    #[error("cannot start {jobs} threads; give fewer with --jobs")]
    Threads {
        /// Number of threads asked for.
        jobs: u32,
        /// Reason why the threads cannot be started.
        source: BoxError,
    },
    /// A run could not be played.
    #[error(
        "table {table}, row {row}, run {run} (seed {seed}) could not be played; name the other rows with --row"
    )]
    Run {
        /// Name of the table.
        table: String,
        /// Name of the row.
        row: String,
        /// Index of the run, from 0.
        run: u32,
        /// Seed of the run.
        seed: u64,
        /// Reason why the run could not be played.
        source: BoxError,
    },
    /// The runs of a table cannot be replayed.
    #[error(
        "the runs of table {table} are not recorded, so there is nothing to replay; choose another table"
    )]
    NoReplay {
        /// Name of the table.
        table: String,
    },
    /// A file of runs has an invalid line.
    #[error("{}, line {line}: {what}; compare folders that `tolman experiment` wrote", path.display())]
    NoRuns {
        /// Path of the file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: u64,
        /// The fault, in words.
        what: String,
    },
    /// A folder holds no chunks.
    #[error(
        "there are no chunks in {0}; make each with `tolman trial --experiment NAME --chunk I/K \
         --out {0}`",
        folder.display()
    )]
    NoChunks {
        /// Path of the folder.
        folder: PathBuf,
    },
    /// A chunk, or the folder of results, belongs to another experiment, configuration or build.
    #[error(
        "{} holds results of {reason}; remove it, or merge with the program that made it and the \
         mazes as they were",
        folder.display()
    )]
    OtherChunk {
        /// Path of the folder.
        folder: PathBuf,
        /// The difference, in words.
        reason: String,
    },
    /// A folder cannot be verified with this command or program.
    #[error(
        "{} cannot be verified: it was made with {reason}; give the options and the program of \
         the command in its config.toml",
        folder.display()
    )]
    NotVerifiable {
        /// Path of the folder.
        folder: PathBuf,
        /// The difference, in words.
        reason: String,
    },
    /// Chunks are unfinished or missing.
    #[error("{missing} of {total} runs are missing; run these chunks again: {chunks}")]
    Incomplete {
        /// Number of runs that no chunk has.
        missing: usize,
        /// Number of runs of the whole experiment.
        total: usize,
        /// Chunks that the missing runs belong to, as I/K.
        chunks: String,
    },
    /// The figures could not be drawn.
    #[error("the figures of experiment {name} could not be drawn")]
    Figures {
        /// Name of the experiment.
        name: String,
        /// Reason why a figure could not be drawn.
        source: BoxError,
    },
    /// The caller asked the experiment to stop.
    #[error(
        "stopped after {done} of {total} runs, which are kept in {}; go on from there with: \
         {command}",
        folder.display()
    )]
    Interrupted {
        /// Number of finished runs.
        done: u64,
        /// Number of runs of the whole experiment.
        total: u64,
        /// Path of the folder of results.
        folder: PathBuf,
        /// Command that continues the experiment.
        command: String,
    },
}

impl Error {
    /// Returns the index of a name among `known` ones.
    pub(super) fn place_of<'a>(
        what: &'static str,
        name: &str,
        mut known: impl Iterator<Item = &'a str> + Clone,
    ) -> Result<usize, Self> {
        let all = known.clone();
        known
            .position(|known| known == name)
            .ok_or_else(|| Self::Unknown {
                what,
                name: name.to_owned(),
                choices: choices(name, all),
            })
    }

    /// Returns the error about a run that could not be played.
    pub(super) fn run(job: &Job<'_>, source: BoxError) -> Self {
        Self::Run {
            table: job.table.to_owned(),
            row: job.row.to_owned(),
            run: job.run,
            seed: job.seed,
            source,
        }
    }

    /// Returns whether the caller's input is at fault (exit code 2) rather than the machine or the
    /// experiment (exit code 1).
    pub const fn is_bad_input(&self) -> bool {
        !matches!(
            self,
            Self::Tables { .. }
                | Self::File { .. }
                | Self::Config { .. }
                | Self::Summary { .. }
                | Self::Threads { .. }
                | Self::Run { .. }
                | Self::Figures { .. }
                | Self::Interrupted { .. }
        )
    }
}
