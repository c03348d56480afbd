//! Experiments by their names.

use super::{BoxError, Error, Experiment, Options};

/// One experiment of a catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Name on the command line and in `summary.json`.
    pub name: &'static str,
    /// Description in one line: the title of the report.
    pub title: &'static str,
    /// Paper whose tables these are, as a reader would cite it; empty if there is none.
    pub source: &'static str,
    /// Default number of runs of each row.
    pub runs: u32,
    /// Number of runs of each row with `--quick`, for a first look.
    pub quick_runs: u32,
    /// Names of the main tables, which come first on the page.
    pub main: &'static [&'static str],
    /// Lines in the tour of all experiments.
    pub tour: &'static [Headline],
    /// Prepares the experiment: reads the mazes that the options name.
    pub open: fn(&Options) -> Result<Experiment, BoxError>,
}

/// A line in the tour of all experiments: one value beside the paper's, or beside a rival's, in a
/// few seconds.
#[derive(Clone, Copy, Debug)]
pub struct Headline {
    /// Title of the system.
    pub system: &'static str,
    /// What is measured, in at most 28 characters.
    pub measures: &'static str,
    /// Name of the table.
    pub table: &'static str,
    /// Name of the row.
    pub row: &'static str,
    /// Name of the metric.
    pub metric: &'static str,
    /// Value beside which it stands.
    pub beside: Beside,
    /// Number of runs of each row. `None` takes that of `--quick`, as tables with a fixed number
    /// require.
    pub runs: Option<u32>,
}

/// What a [`Headline`] is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// The paper's value.
    Paper,
    /// Another row of the table.
    Rival {
        /// Name of the row.
        row: &'static str,
        /// What the tour calls it.
        called: &'static str,
    },
    /// Nothing that is known to do the same.
    Nothing,
}

/// Returns the experiment called `name`, prepared with `options`.
///
/// # Errors
/// - [`Error::Unknown`] if there is no such experiment, or it lacks a table or row that the options
///   name.
/// - [`Error::FixedRuns`] if such a table has a fixed number of runs and the options ask for
///   another.
/// - [`Error::Open`] if its input cannot be read.
pub fn open(catalogue: &[Entry], name: &str, options: &Options) -> Result<Experiment, Error> {
    let names = catalogue.iter().map(|entry| entry.name);
    let entry = &catalogue[Error::place_of("experiment", name, names)?];
    let experiment = (entry.open)(options).map_err(|source| Error::Open {
        name: name.to_owned(),
        source,
    })?;
    experiment.choose(options)?.with_runs(options)
}
