//! The tables of the papers: one folder a set of tables, filled by the project's systems.
//!
//! [`catalogue`] lists them as the experiments that `tolman experiment` knows. What a map or a run looks
//! like is drawn in the folder of its paper: [`mslst::drawing`], [`cpm::drawing`],
//! [`diktiometry::drawing`]; [`Recorder`] makes the replay of a run, [`plan_of_course`] the plan it is drawn over.
//! [`data`] finds what other people measured.

extern crate alloc;

mod baselines;
pub mod cpm;
pub mod data;
pub mod diktiometry;
mod maze_file;
mod micromouse;
pub mod mslst;
mod mslst_sweeps;
mod plan;
mod quantizers;
mod recorder;
mod venue;

use tolman_experiment::Entry;

pub use plan::plan_of_course;
pub use recorder::Recorder;

/// All experiments, in the order they are listed.
#[must_use]
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

#[cfg(test)]
mod tests {
    use tolman_experiment::Options;

    use super::catalogue;

    #[test]
    fn every_configuration_can_be_written() {
        for entry in catalogue() {
            let experiment = (entry.open)(&Options::default()).unwrap();
            let config = experiment.config().unwrap();
            let text = toml::to_string(&config).unwrap();
            assert_eq!(text.parse::<toml::Table>().unwrap(), config);
        }
    }
}
