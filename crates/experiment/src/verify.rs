//! Checks a folder of results: a sample of its runs is played again.

use alloc::collections::BTreeMap;
use core::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::at::if_there;
use super::config_file::ConfigFile;
use super::hash::fnv64;
use super::runs_file;
use super::{
    Analysis, Build, Error, Experiment, Options, Progress, ProgressEvent, Run, Summary, check,
    compare, folder, runner,
};

/// Result of verifying a folder of results. [`Display`](fmt::Display) writes a line for each fault.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Verification {
    /// Path of the folder.
    pub folder: PathBuf,
    /// Number of runs in the folder.
    pub runs: usize,
    /// Number of runs that were played again.
    pub played: usize,
    /// Faults of the folder, one per entry; empty if there are none.
    pub faults: Vec<String>,
}

impl fmt::Display for Verification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (folder, Self { runs, played, .. }) = (self.folder.display(), self);
        if self.faults.is_empty() {
            return write!(
                f,
                "{folder}: {played} of {runs} runs were played again and agree to the bit"
            );
        }
        write!(
            f,
            "{folder} is not what its experiment makes; {played} of {runs} runs were played again:"
        )?;
        self.faults
            .iter()
            .try_for_each(|fault| write!(f, "\n  {fault}"))
    }
}

/// Verifies a folder of results without writing to it.
///
/// - Every line of `runs.jsonl` has to be valid and to have its checksum.
/// - Of each row, `Options::runs` runs (by default 1) are played again, and have to agree to the
///   bit. A hash of their seeds chooses them.
/// - `summary.json`, if present, has to follow from the runs.
///
/// # Errors
/// - [`Error::NotVerifiable`] if the folder was made with other options or by another program.
/// - [`Error::Run`] if a run cannot be played.
/// - [`Error::File`] if the folder cannot be read.
pub fn verify(
    experiment: &Experiment,
    options: &Options,
    build: &Build,
    path: &Path,
    progress: &dyn Progress,
) -> Result<Verification, Error> {
    check::options(options, &experiment.entry)?;
    check::tables(experiment)?;
    let refuse = |reason: String| Error::NotVerifiable {
        folder: path.to_owned(),
        reason,
    };
    let config = ConfigFile::new(experiment, options, build);
    if let Some(reason) = folder::conflict(path, &config)? {
        return Err(refuse(reason));
    }
    let file = path.join(folder::RUNS);
    let broken = BrokenLines::default();
    let runs = runs_file::read([&*file], experiment, options.seed, u32::MAX, &broken)?;
    if runs.is_empty() {
        return Err(refuse("no run".to_owned()));
    }
    let mut faults = broken
        .0
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);
    let sample = sample(&runs, options.runs.unwrap_or(1));
    progress.event(&ProgressEvent::Started {
        total: sample.len() as u64,
        reused: 0,
    });
    let differing: Result<Vec<Vec<String>>, Error> = sample
        .par_iter()
        .with_max_len(1)
        .filter(|_| !progress.stop_requested())
        .map(|run| {
            let again = runner::play_one(experiment, &run.job())?;
            progress.event(&ProgressEvent::RunFinished);
            let changes = compare::changes(Some(run), Some(&again)).into_iter();
            let (table, row, index) = (&run.table, &run.row, run.run);
            Ok(changes
                .map(|(what, change)| {
                    format!("table {table}, row {row}, run {index}: {what} {change} when played")
                })
                .collect())
        })
        .collect();
    let differing = differing?;
    let played = differing.len();
    faults.extend(differing.into_iter().flatten());
    let all: Vec<Run> = runs.into_values().collect();
    let summary = path.join("summary.json");
    if let Some(written) = if_there("read", &summary, fs::read_to_string(&summary))? {
        let analysis = Analysis::of(experiment, &all, options.seed);
        let summary = Summary::of(experiment.entry.name, options.seed, &analysis);
        if written != summary.to_json()? {
            faults.push("summary.json does not follow from runs.jsonl".to_owned());
        }
    }
    Ok(Verification {
        folder: path.to_owned(),
        runs: all.len(),
        played,
        faults,
    })
}

/// Returns `of_each_row` runs of each row, those whose seeds have the smallest hashes.
fn sample(runs: &runs_file::Runs, of_each_row: u32) -> Vec<&Run> {
    let mut rows: BTreeMap<(usize, usize), Vec<(u64, &Run)>> = BTreeMap::new();
    for ((table, row, _), run) in runs {
        let hash = fnv64(&run.seed.to_le_bytes());
        rows.entry((*table, *row)).or_default().push((hash, run));
    }
    let mut chosen = Vec::new();
    for mut row in rows.into_values() {
        row.sort_by_key(|(hash, run)| (*hash, run.run));
        let of_row = row.into_iter().take(of_each_row as usize);
        chosen.extend(of_row.map(|(_, run)| run));
    }
    chosen
}

/// Collects the lines that cannot be used.
#[derive(Debug, Default)]
struct BrokenLines(Mutex<Vec<String>>);

impl Progress for BrokenLines {
    fn event(&self, event: &ProgressEvent<'_>) {
        if let ProgressEvent::BrokenLine { line, what, .. } = event {
            let mut lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            lines.push(format!("runs.jsonl, line {line}: {what}"));
        }
    }
}
