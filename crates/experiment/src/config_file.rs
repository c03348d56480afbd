//! Reads and writes `config.toml`, which holds everything needed to repeat the results.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};

use super::{Build, Error, Experiment, Options};

const FORMAT: &str = "tolman experiment";

/// The contents of `config.toml`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ConfigFile {
    format: String,
    version: u32,
    experiment: String,
    /// Command that repeats the results.
    pub(super) command: String,
    seed: u64,
    runs: u32,
    build: Build,
    configuration: toml::Table,
}

impl ConfigFile {
    /// Returns the configuration of an experiment about to run.
    pub(super) fn new(experiment: &Experiment, options: &Options, build: &Build) -> Self {
        let entry = &experiment.entry;
        let mut configuration = experiment.config.clone();
        if let Some(caster) = options.caster {
            configuration.insert("caster".to_owned(), caster.into());
        }
        Self {
            format: FORMAT.to_owned(),
            version: 1,
            command: options.command_of(entry),
            experiment: entry.name.to_owned(),
            seed: options.seed,
            runs: options.runs_of(entry),
            build: build.clone(),
            configuration,
        }
    }

    /// Reads the text of a `config.toml`; `None` if the file has another format.
    pub(super) fn parse(text: &str) -> Option<Self> {
        toml::from_str(text)
            .ok()
            .filter(|file: &Self| file.format == FORMAT)
    }

    /// Returns the text of `config.toml`.
    pub(super) fn text(&self) -> Result<String, Error> {
        toml::to_string_pretty(self).map_err(|source| Error::Config {
            name: self.experiment.clone(),
            source,
        })
    }

    /// Returns why results with the configuration `former` cannot be combined with results of this
    /// one; `None` if they can. The number of runs may differ, because runs are independent.
    pub(super) fn conflict_with(&self, former: &Self) -> Option<String> {
        if former.version != self.version {
            Some(format!("version {} of the folder's format", former.version))
        } else if former.experiment != self.experiment {
            Some(format!("experiment {}", former.experiment))
        } else if former.seed != self.seed {
            Some(format!("seed {}", former.seed))
        } else if former.configuration != self.configuration {
            Some("another configuration, see config.toml there".to_owned())
        } else if former.build.executable != self.build.executable {
            Some(format!("another build, of commit {}", former.build.commit))
        } else {
            None
        }
    }
}
