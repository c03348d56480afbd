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
    /// Part in the tour of all experiments; `None` to leave it out.
    pub tour: Option<Tour>,
    /// Prepares the experiment: reads the mazes that the options name.
    pub open: fn(&Options) -> Result<Experiment, BoxError>,
}

/// Part of an experiment in the tour of all: its main tables, in a few seconds.
#[derive(Clone, Copy, Debug)]
pub struct Tour {
    /// The names of the tables.
    pub tables: &'static [&'static str],
    /// Number of runs of each row. `None` takes that of `--quick`, as tables with a fixed number
    /// require.
    pub runs: Option<u32>,
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
