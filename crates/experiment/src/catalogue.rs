//! Experiments by their names.

use super::chosen::choose;
use super::{BoxError, Error, Experiment, Options};

/// One experiment of a catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name it is called by.
    pub name: &'static str,
    /// What it is, in one line.
    pub title: &'static str,
    /// Makes it ready: reads the mazes that the options name.
    pub open: fn(&Options) -> Result<Box<dyn Experiment>, BoxError>,
}

/// Makes the experiment of a catalogue that bears this name ready.
///
/// # Errors
/// [`Error::Unknown`] if there is none of that name, [`Error::Open`] if what it needs cannot be read, [`Error::NoRow`]
/// if it lacks a table that the options choose.
pub fn open(
    catalogue: &[Entry],
    name: &str,
    options: &Options,
) -> Result<Box<dyn Experiment>, Error> {
    let entry = catalogue
        .iter()
        .find(|entry| entry.name == name)
        .ok_or_else(|| {
            let known: Vec<&str> = catalogue.iter().map(|entry| entry.name).collect();
            Error::Unknown {
                name: name.to_owned(),
                known: known.join(", "),
            }
        })?;
    let experiment = (entry.open)(options).map_err(|source| Error::Open {
        name: name.to_owned(),
        source,
    })?;
    choose(experiment, &options.tables)
}
