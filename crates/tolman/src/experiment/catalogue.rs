//! The experiments there are.

use super::chosen::choose;
use super::{
    BoxError, Error, Experiment, Options, baselines, cpm, diktiometry, micromouse, mslst,
    mslst_sweeps, quantizers,
};

/// One experiment of the catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name it is called by.
    pub name: &'static str,
    /// What it is, in one line.
    pub title: &'static str,
    /// Makes it ready: reads the mazes that the options name.
    pub open: fn(&Options) -> Result<Box<dyn Experiment>, BoxError>,
}

/// All experiments, in the order they are listed.
pub const fn catalogue() -> &'static [Entry] {
    &[
        Entry {
            name: "baselines",
            title: "Mazes without a map: MSLST's baselines",
            open: baselines::open,
        },
        Entry {
            name: "quantizers",
            title: "Quantizers: states out of scans, clusters out of noise",
            open: quantizers::open,
        },
        Entry {
            name: "mslst",
            title: "MSLST: maze solving by learning state topologies",
            open: mslst::open,
        },
        Entry {
            name: "mslst-sweeps",
            title: "MSLST under other settings and in other worlds",
            open: mslst_sweeps::open,
        },
        Entry {
            name: "micromouse",
            title: "A micromouse in a virtual maze",
            open: micromouse::open,
        },
        Entry {
            name: "diktiometry",
            title: "Diktiometry: maps considered as adaptive planning resources",
            open: diktiometry::open,
        },
        Entry {
            name: "cpm",
            title: "CPM: common-pattern maps on an e-puck",
            open: cpm::open,
        },
    ]
}

/// Makes an experiment ready by its name.
///
/// # Errors
/// [`Error::Unknown`] if there is none of that name, [`Error::Open`] if what it needs cannot be read, [`Error::NoRow`]
/// if it lacks a table that the options choose.
pub fn open(name: &str, options: &Options) -> Result<Box<dyn Experiment>, Error> {
    let entry = catalogue()
        .iter()
        .find(|entry| entry.name == name)
        .ok_or_else(|| {
            let known: Vec<&str> = catalogue().iter().map(|entry| entry.name).collect();
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
