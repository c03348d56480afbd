//! Fuzzing without a nightly compiler: every format with what must hold of its reader, seeds that
//! are valid, and a mutator.
//!
//! [`TARGETS`] is the one table. `cargo xtask ci` gives each reader a few hundred mutated seeds,
//! `cargo xtask fuzz` as many as there is time for. The folder `fuzz` has a target of libFuzzer for
//! each line of the table. The seeds lie in `fuzz/seeds`, a folder a target.

#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a broken promise of a reader is a panic, which the fuzzer reports"
)]

mod campaign;
mod mutator;
mod readers;

use std::path::PathBuf;
use std::{fs, io};

pub use campaign::{Campaign, Fault, Findings};
pub use mutator::Mutator;

/// What a reader made of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It could use it, or part of it.
    Taken,
    /// It said what is wrong with it.
    Refused,
}

impl Answer {
    const fn of<T, E>(read: &Result<T, E>) -> Self {
        match read {
            Ok(_) => Self::Taken,
            Err(_) => Self::Refused,
        }
    }
}

/// A format and its reader.
#[derive(Clone, Copy, Debug)]
pub struct FuzzTarget {
    /// Its name, also of its folder of seeds and of its target of libFuzzer.
    pub name: &'static str,
    /// Reads a file and panics if the reader does not hold to what it promises.
    pub check: fn(&[u8]) -> Answer,
}

macro_rules! targets {
    ($($(#[$attribute:meta])* $name:ident),* $(,)?) => {
        &[$($(#[$attribute])* FuzzTarget { name: stringify!($name), check: readers::$name }),*]
    };
}

/// All formats that are read.
pub const TARGETS: &[FuzzTarget] = targets![
    read,
    tolman,
    numbers,
    mazefiles,
    num,
    world,
    ros_map_header,
    grey_map,
    ros_map,
    carmen,
    relations,
    tum,
    utias,
    tuc,
    sonar_table,
    g2o,
    whole_log,
    trace,
    trace_of_epuck,
    map_of_mslst,
    map_of_mslst_better,
    map_of_cpm,
    map_of_gngslam,
    map_of_diktiometry,
    data_set,
    runs,
    epuck_serial,
    mms_mouse,
    mms_host,
];

impl FuzzTarget {
    /// Returns the target of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        TARGETS.iter().find(|target| target.name == name)
    }

    /// Returns its seeds, in the order of their names.
    ///
    /// # Errors
    /// If its folder cannot be read or is empty.
    pub fn seeds(&self) -> io::Result<Vec<Vec<u8>>> {
        let folder = seed_folders().join(self.name);
        let missing = |error: io::Error| {
            io::Error::new(error.kind(), format!("{}: {error}", folder.display()))
        };
        let listed = fs::read_dir(&folder).map_err(missing)?;
        let mut paths = listed
            .map(|entry| Ok(entry?.path()))
            .collect::<io::Result<Vec<_>>>()?;
        paths.sort();
        let seeds: Vec<Vec<u8>> = paths.iter().map(fs::read).collect::<io::Result<_>>()?;
        match seeds.is_empty() {
            true => Err(missing(io::ErrorKind::NotFound.into())),
            false => Ok(seeds),
        }
    }
}

/// Returns the folder that has a folder of seeds for each target.
#[must_use]
pub fn seed_folders() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fuzz/seeds")
}

/// Reads a file as the target of that name, for libFuzzer.
///
/// # Panics
/// If there is no such target, or its reader does not hold to what it promises.
pub fn check(name: &str, bytes: &[u8]) {
    let target = FuzzTarget::named(name).expect("a target of the table");
    let _ = (target.check)(bytes);
}
