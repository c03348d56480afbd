//! The runner of experiments: plays every run of every row of every table, in parallel, and can be
//! interrupted and resumed.
//!
//! An [`Experiment`] says which [`Table`]s it fills. Its [`Procedure`] says how one run is played,
//! and which pictures it adds. The runner knows nothing of mazes or robots. It plays the missing
//! [`Job`]s, keeps a folder of results that can be resumed, and summarizes.
//!
//! Each run is identified by table, row and index. Its seed follows from the master seed, the table
//! and the index, *not* from the row. So every row of a table meets the same starts and the same
//! noise, and rows can be compared in pairs.
//!
//! A run measures a [`Record`]: a struct whose fields carry title, unit, direction of better,
//! tolerance, range and definition, declared once by [`record!`]. Results already in a folder are
//! reused only if they are in their ranges and pass [`Record::check`]. For a run just played,
//! failing this is an error.
//!
//! # An experiment of your own
//!
//! `cargo run --example coins`:
#![doc = "```"]
#![doc = include_str!("../examples/coins.rs")]
#![doc = "```"]

extern crate alloc;

mod analysis;
mod at;
mod build;
mod catalogue;
mod check;
mod choices;
mod chunk;
mod column;
mod compare;
mod config_file;
mod difference;
mod easel;
mod error;
mod experiment;
pub mod files;
mod folder;
mod hash;
mod merge;
mod options;
mod pairwise;
mod pictures;
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
mod tally;
mod terminal;
mod text;
mod tour;
mod verdict;
mod verify;

pub use analysis::{Analysis, Contrast, Measured, MetricAnalysis, TableAnalysis};
pub use build::Build;
pub use catalogue::{Beside, Entry, Headline, open};
pub use choices::choices;
pub use chunk::{Chunk, ChunkError};
pub use column::{Better, Column, Kind, Presence, Value};
pub use compare::{Differences, compare};
pub use easel::Easel;
pub use error::Error;
pub use experiment::{Experiment, Procedure};
pub use merge::{command_of_chunks, merge};
pub use options::{Options, Program};
pub use pairwise::{Pairwise, RowPair};
pub use progress::{Progress, ProgressEvent, Remedy, Silent};
pub use record::{FieldsError, Record, RecordType, require};
pub use replay_file::write_replay;
pub use replays::{Recorded, Replays};
pub use report::{League, LeagueTable, LeagueValue, league_html, tour_html};
pub use run::{Fields, Job, Run};
pub use runner::{ExperimentOutcome, execute, play_chunk};
pub use seed::run_seed;
pub use settling::{Reached, Settling};
pub use summary::{P_TABLE, Summary, SummaryRow};
pub use table::{
    Centre, Comparison, Correction, Metric, PaperValue, Row, Statistic, Table, Tolerance, Within,
};
pub use tally::VerdictTally;
pub use terminal::Terminal;
pub use text::{Ink, tables_as_text, wrapped};
pub use tour::TourLine;
pub use verdict::{Doubt, Finding, Verdict};
pub use verify::{Verification, verify};

pub(crate) use sample::RESAMPLES;
pub(crate) use terminal::duration;
pub(crate) use text::{heading, ours, value_with_spread};

/// Error inside an experiment; the runner adds where it happened.
pub type BoxError = Box<dyn core::error::Error + Send + Sync>;
