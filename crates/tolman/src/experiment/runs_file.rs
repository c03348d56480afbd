//! `runs.jsonl`: one line a run, appended as runs finish, sorted at the end.

use alloc::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::files::{at, write_whole};
use super::{Error, Event, Experiment, Progress, Run, run_seed};

/// The places of a run's table and row, and its index: the order of the finished file.
pub(super) type Key = (usize, usize, u32);

/// The runs of a folder by key.
pub(super) type Runs = BTreeMap<Key, Run>;

/// Reads the usable runs of a file into `runs`; tells of every line that is not usable. A file that
/// is not there has no runs.
pub(super) fn read(
    path: &Path,
    experiment: &dyn Experiment,
    master_seed: u64,
    progress: &dyn Progress,
    runs: &mut Runs,
) -> Result<(), Error> {
    let bytes = match fs::read(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        result => at("read", path, result)?,
    };
    for (line, text) in (1..).zip(bytes.split(|&byte| byte == b'\n')) {
        if text.is_empty() {
            continue;
        }
        let result =
            parse(text, experiment, master_seed).and_then(|(key, run)| match runs.get(&key) {
                Some(known) if *known != run => Err("it contradicts an earlier line".to_owned()),
                _ => Ok((key, run)),
            });
        match result {
            Ok((key, run)) => {
                runs.insert(key, run);
            }
            Err(what) => progress.event(&Event::BrokenLine {
                file: path,
                line,
                what: &what,
            }),
        }
    }
    Ok(())
}

fn parse(line: &[u8], experiment: &dyn Experiment, master: u64) -> Result<(Key, Run), String> {
    let run: Run = serde_json::from_slice(line).map_err(|error| {
        // It was given one line, so the line it names is not that of the file.
        let what = error.to_string();
        let what = what.split(" at line ").next().unwrap_or_default();
        format!("{what} at column {}", error.column())
    })?;
    let key = key_of(experiment, &run)
        .ok_or_else(|| format!("there is no row {:?} in a table {:?}", run.row, run.table))?;
    let seed = run_seed(master, &run.table, run.run);
    if run.seed == seed {
        Ok((key, run))
    } else {
        Err(format!(
            "run {} has seed {} where {seed} belongs",
            run.run, run.seed
        ))
    }
}

fn key_of(experiment: &dyn Experiment, run: &Run) -> Option<Key> {
    let tables = experiment.tables();
    let table = tables.iter().position(|table| table.name == run.table)?;
    let row = tables[table]
        .rows
        .iter()
        .position(|row| row.name == run.row)?;
    Some((table, row, run.run))
}

/// Writes runs in order, as a whole file.
pub(super) fn write<'a>(path: &Path, runs: impl Iterator<Item = &'a Run>) -> Result<(), Error> {
    let mut text = Vec::new();
    for run in runs {
        at("write", path, write_line(&mut text, run))?;
    }
    write_whole(path, &text)
}

fn write_line(out: &mut Vec<u8>, run: &Run) -> io::Result<()> {
    serde_json::to_writer(&mut *out, run)?;
    out.push(b'\n');
    Ok(())
}

/// A file that runs are added to from several threads.
#[derive(Debug)]
pub(super) struct Appender {
    path: PathBuf,
    file: Mutex<File>,
}

impl Appender {
    /// Opens a file that is there.
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
        let file = at("open", path, OpenOptions::new().append(true).open(path))?;
        Ok(Self {
            path: path.to_owned(),
            file: Mutex::new(file),
        })
    }

    /// Adds one run. The line goes to the system at once, so it outlives the end of this process.
    pub(super) fn append(&self, run: &Run) -> Result<(), Error> {
        let mut line = Vec::new();
        let written = write_line(&mut line, run).and_then(|()| {
            // A thread that panicked while it held the file has written a whole line or a broken
            // one, which the next reading reports.
            let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
            file.write_all(&line)
        });
        at("add a run to", &self.path, written)
    }
}
