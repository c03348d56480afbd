//! Experiments by their names.

use super::{BoxError, Error, Experiment, Options};

/// One experiment of a catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name it is called by on the command line and in `summary.json`.
    pub name: &'static str,
    /// Description in one line: the title of the report.
    pub title: &'static str,
    /// The paper whose tables these are, as a reader would cite it; empty if there is none.
    pub source: &'static str,
    /// Runs of each row when the caller names no number.
    pub runs: u32,
    /// Runs of each row under `--quick`, for a first look.
    pub quick_runs: u32,
    /// Part in the tour of all experiments; `None` leaves it out.
    pub tour: Option<Tour>,
    /// Makes it ready: reads the mazes that the options name.
    pub open: fn(&Options) -> Result<Experiment, BoxError>,
}

/// Part of an experiment in the tour of all: its main tables, in a few seconds.
#[derive(Clone, Copy, Debug)]
pub struct Tour {
    /// The names of the tables.
    pub tables: &'static [&'static str],
    /// Runs of each row; `None` for those of `--quick`, which tables with a number of their own
    /// need.
    pub runs: Option<u32>,
}

/// Makes the experiment of a catalogue that bears this name ready.
///
/// # Errors
/// [`Error::Unknown`] if there is none of that name, or it lacks a table or row that the options
/// choose; [`Error::FixedRuns`] if such a table has a number of runs of its own and the options ask
/// for another; [`Error::Open`] if what it needs cannot be read.
pub fn open(catalogue: &[Entry], name: &str, options: &Options) -> Result<Experiment, Error> {
    let names = catalogue.iter().map(|entry| entry.name);
    let entry = &catalogue[Error::place_of("experiment", name, names)?];
    let experiment = (entry.open)(options).map_err(|source| Error::Open {
        name: name.to_owned(),
        source,
    })?;
    experiment.choose(options)?.with_runs(options)
}
