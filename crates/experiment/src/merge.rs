//! Merges the chunks of an experiment.

use alloc::collections::BTreeSet;
use core::iter::once;
use std::fs;
use std::path::Path;

use super::at::at;
use super::chunk::{Chunk, deal};
use super::config_file::ConfigFile;
use super::folder::{CONFIG, Folder, RUNS, conflict};
use super::runner::{execute, jobs};
use super::{Build, Error, Experiment, ExperimentOutcome, Options, Progress, check, runs_file};

/// Returns the command that the chunks in a folder of results belong to.
///
/// # Errors
/// [`Error::NoChunks`] if there are none; [`Error::File`] if one cannot be read.
pub fn command_of_chunks(results: &Path) -> Result<String, Error> {
    for chunk in Chunk::all_in(results)? {
        let file = chunk.folder_in(results).join(CONFIG);
        let text = at("read", &file, fs::read_to_string(&file))?;
        if let Some(config) = ConfigFile::parse(&text) {
            return Ok(config.command);
        }
    }
    Err(no_chunks(results))
}

/// Merges the chunks in the experiment's folder into its results. They are the same to the byte as
/// those that [`execute`] writes on one machine.
///
/// # Errors
/// - [`Error::NoChunks`] if there are no chunks.
/// - [`Error::OtherChunk`] if one has another experiment, configuration or build.
/// - [`Error::Incomplete`] if runs are missing.
/// - The errors of [`execute`].
pub fn merge(
    experiment: &Experiment,
    options: &Options,
    build: &Build,
    progress: &dyn Progress,
) -> Result<ExperimentOutcome, Error> {
    check::options(options, &experiment.entry)?;
    check::tables(experiment)?;
    let results = options.folder_of(experiment.entry.name);
    let config = ConfigFile::new(experiment, options, build);
    let chunks = Chunk::all_in(&results)?;
    let most = chunks.iter().map(|chunk| chunk.of()).max();
    let most = most.ok_or_else(|| no_chunks(&results))?;

    let folders = chunks.iter().map(|chunk| chunk.folder_in(&results));
    let folders: Vec<_> = once(results.clone()).chain(folders).collect();
    for folder in &folders {
        if let Some(reason) = conflict(folder, &config)? {
            return Err(Error::OtherChunk {
                folder: folder.clone(),
                reason,
            });
        }
    }
    let files: Vec<_> = folders.iter().map(|folder| folder.join(RUNS)).collect();
    let runs = options.runs_of(&experiment.entry);
    let files = files.iter().map(AsRef::as_ref);
    let known = runs_file::read(files, experiment, options.seed, runs, progress)?;

    let all = jobs(experiment, options.seed, runs);
    let dealt = deal(&all, most, &*experiment.procedure);
    let missing = all.iter().zip(dealt);
    let missing: Vec<u32> = missing
        .filter(|((key, _), _)| !known.contains_key(key))
        .map(|(_, chunk)| chunk)
        .collect();
    if !missing.is_empty() {
        let again: BTreeSet<_> = missing.iter().copied().collect();
        let again: Vec<_> = again
            .iter()
            .map(|number| format!("{number}/{most}"))
            .collect();
        return Err(Error::Incomplete {
            missing: missing.len(),
            total: all.len(),
            chunks: again.join(", "),
        });
    }
    let runs: Vec<_> = known.into_values().collect();
    Folder::open(&results, &config, progress)?.write_runs(&runs)?;
    execute(experiment, options, build, progress)
}

fn no_chunks(results: &Path) -> Error {
    Error::NoChunks {
        folder: results.to_owned(),
    }
}
