//! The tables of the papers, filled by the project's systems. Each paper has a folder.
//!
//! [`catalogue`] lists them as the experiments of `tolman experiment`. [`data`] finds
//! external data, and [`real`] reads logs and pose graphs.
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

pub mod arena;
mod baselines;
pub mod cpm;
pub mod data;
pub mod diktiometry;
pub mod gngslam;
mod kept;
mod maze_file;
mod metrics;
mod micromouse;
pub mod mslst;
mod mslst_drawings;
mod mslst_sweeps;
mod plan;
mod quantizers;
pub mod real;
mod rows;
mod tolerances;
mod tolman;
mod venue;

use tolman_experiment::Entry;

/// Returns all experiments, in the order in which they are listed.
#[must_use]
pub const fn catalogue() -> &'static [Entry] {
    &[
        baselines::ENTRY,
        quantizers::ENTRY,
        mslst::ENTRY,
        mslst_drawings::ENTRY,
        mslst_sweeps::ENTRY,
        micromouse::ENTRY,
        diktiometry::ENTRY,
        cpm::ENTRY,
        gngslam::ENTRY,
        arena::ENTRY,
        tolman::ENTRY,
        real::ENTRY,
    ]
}

#[cfg(test)]
mod tests {
    use tolman_experiment::Options;

    use super::catalogue;

    #[test]
    fn every_configuration_can_be_written() {
        for entry in catalogue() {
            let config = (entry.open)(&Options::default()).unwrap().config;
            let text = toml::to_string(&config).unwrap();
            assert_eq!(text.parse::<toml::Table>().unwrap(), config);
        }
    }
}
