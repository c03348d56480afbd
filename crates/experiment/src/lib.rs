//! The runner of experiments: every run of every row of every table, in parallel, resumable.
//!
//! An [`Experiment`] says which [`Table`]s it fills, how one run is played, and which pictures it
//! adds. The runner knows nothing of mazes or robots: it plays the [`Job`]s that are missing, keeps
//! a folder of results that can be resumed, and summarizes.
//!
//! Each run is keyed by table, row and index. Its seed comes from the master seed, the table and
//! the index, *not* the row, so that every row of a table meets the same starts and the same noise
//! and rows can be compared in pairs.
//!
//! What a run measures is a [`Record`]: a struct whose fields carry title, unit, direction of better,
//! tolerance, range and definition, declared once by [`record!`]. Results that lie in a folder are
//! reused only if they are in their ranges and pass [`Record::check`]; a run just played that does not
//! is an error.

extern crate alloc;

mod analysis;
mod at;
mod build;
mod catalogue;
mod check;
mod chosen;
mod column;
mod compare;
mod config_file;
mod error;
pub mod files;
mod folder;
mod hash;
mod options;
mod pairwise;
mod plots;
mod progress;
mod record;
mod replay_file;
mod replays;
mod report;
mod run;
mod runner;
mod runs_file;
mod sample;
mod seed;
mod settling;
pub mod shell;
mod summary;
mod table;
mod terminal;
mod text;
mod verdict;

pub use analysis::{Analysis, Contrast, Disagreement, Measured, MetricAnalysis, TableAnalysis};
pub use build::Build;
pub use catalogue::{Entry, open};
pub use column::{Better, Column, Kind, Presence, Value};
pub use compare::{Differences, compare};
pub use error::Error;
pub use options::{Options, Program};
pub use pairwise::{Pair, Pairwise};
pub use progress::{Event, Progress, Remedy, Silent};
pub use record::{Record, RecordError, RecordType, require};
pub use replay_file::write_replay;
pub use replays::{Recorded, Replays};
pub use run::{Fields, Job, Run};
pub use runner::{Outcome, execute};
pub use seed::run_seed;
pub use settling::{Reached, Settling};
pub use summary::{P_TABLE, Summary, SummaryRow};
pub use table::{Comparison, Correction, Metric, PaperValue, Row, Statistic, Table, Tolerance};
pub use terminal::Terminal;
pub use text::{Ink, tables_as_text};
pub use verdict::{Basis, Verdict};

pub(crate) use sample::RESAMPLES;
pub(crate) use terminal::duration;
pub(crate) use text::{heading, ours, value_with_spread};

use tolman_draw::Figure;
use tolman_replay::Replay;

/// What goes wrong inside an experiment; the runner adds where it happened.
pub type BoxError = Box<dyn core::error::Error + Send + Sync>;

/// One paper's tables and how to fill them.
///
/// ```
/// use tolman_experiment::{BoxError, Experiment, Fields, Job, Metric, Record, Row, Table, record};
///
/// record! {
///     /// One game.
///     struct Game {
///         /// Tosses until the coin showed heads.
///         tosses: u32 => neither("tosses").at_least(1),
///     }
/// }
///
/// /// Tosses a coin until it shows heads.
/// struct Coin {
///     tables: Vec<Table>,
/// }
///
/// impl Experiment for Coin {
///     fn name(&self) -> &str {
///         "coin"
///     }
///     fn title(&self) -> &str {
///         "Tosses until heads"
///     }
///     fn default_runs(&self) -> u32 {
///         1000
///     }
///     fn tables(&self) -> &[Table] {
///         &self.tables
///     }
///     fn config(&self) -> Result<toml::Table, BoxError> {
///         Ok(toml::Table::new())
///     }
///     fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
///         Ok(Game { tosses: job.seed.trailing_zeros() + 1 }.fields()?)
///     }
/// }
///
/// let table = Table::of::<Game>("1", "A fair coin")
///     .metric(Metric::mean(Game::tosses))
///     .row(Row::new("fair"));
/// let coin = Coin { tables: vec![table] };
/// let job = Job { table: "1", row: "fair", run: 0, seed: 8 };
/// assert_eq!(coin.run(&job)?.record::<Game>()?.tosses, 4);
/// # Ok::<(), BoxError>(())
/// ```
pub trait Experiment: Sync {
    /// The name it is called by on the command line and in `summary.json`.
    fn name(&self) -> &str;

    /// The title of the report, in words.
    fn title(&self) -> &str;

    /// The paper whose tables these are, as a reader would cite it; empty if there is none.
    fn source(&self) -> &str {
        ""
    }

    /// Runs of each row when the caller names no number.
    fn default_runs(&self) -> u32;

    /// Runs of each row under `--quick`, for a first look.
    fn quick_runs(&self) -> u32 {
        self.default_runs().min(10)
    }

    /// The tables, in the order they are shown.
    fn tables(&self) -> &[Table];

    /// What is left out because it is not here, and how to have it; `None` if all is here.
    fn skipped(&self) -> Option<&str> {
        None
    }

    /// Everything, apart from the seed and the number of runs, that the results depend on: mazes
    /// with their whole contents, gains, noise. Two experiments with equal configurations give
    /// equal runs; finished runs are reused only then.
    ///
    /// # Errors
    /// If the configuration cannot be written as TOML.
    fn config(&self) -> Result<toml::Table, BoxError>;

    /// Plays one run. A pure function of the job and the configuration: the same job gives the same
    /// fields on every thread, in any order.
    ///
    /// # Errors
    /// If the run cannot be played at all. That a robot does not arrive is a result, not an error.
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError>;

    /// Pictures beside the box plots that every experiment gets. `runs` is complete and sorted by
    /// table, row and index; a run can be played again from its [`Run::job`].
    ///
    /// # Errors
    /// If a run that is to be drawn cannot be played again.
    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let _ = runs;
        Ok(Vec::new())
    }

    /// Plays a run again and records it, so that its dots in the report can be opened. The report
    /// carries the first runs of each row, as many as fit; [`write_replay`] writes any.
    ///
    /// `None`, the default, for runs of which there is nothing to see.
    ///
    /// # Errors
    /// If the run cannot be played again.
    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let _ = job;
        Ok(None)
    }
}
