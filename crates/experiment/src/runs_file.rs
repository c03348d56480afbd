//! `runs.jsonl`: one line per run, appended as runs finish, sorted at the end.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::collections::btree_map::Entry;
use alloc::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::at::{at, if_there, write_whole};
use super::hash::fnv64;
use super::{Error, Experiment, Progress, ProgressEvent, Remedy, Run, check, run_seed};

/// A line of a file: a run or a picture, and the checksum of its text.
#[derive(Serialize, Deserialize)]
struct Line<R> {
    #[serde(flatten)]
    run: R,
    /// Checksum of the line; `None` in files of versions without checksums.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    checksum: Option<String>,
}

/// Returns the value of a line, and whether its checksum is right.
pub(super) fn read_line<R: Serialize + DeserializeOwned>(
    line: &[u8],
) -> Result<(R, Intact), serde_json::Error> {
    let Line { run, checksum }: Line<R> = serde_json::from_slice(line)?;
    let computed = checksum_of(&run)?;
    let intact = match checksum {
        Some(written) if written != computed => Err(format!(
            "its values do not have its checksum {written}, but {computed}"
        )),
        _ => Ok(()),
    };
    Ok((run, intact))
}

/// `Ok` if a line's values have their checksum; otherwise the fault.
pub(super) type Intact = Result<(), String>;

fn checksum_of(run: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(format!("{:016x}", fnv64(&serde_json::to_vec(run)?)))
}

/// Indices of a run's table and row, and its run index: the order of the finished file.
pub(super) type Key = (usize, usize, u32);

/// The runs of a folder by key.
pub(super) type Runs = BTreeMap<Key, Run>;

/// A line that cannot be used.
struct Broken<'a> {
    file: &'a Path,
    line: u64,
    what: String,
    /// Run of the line; `None` if the line does not name it.
    key: Option<Key>,
}

/// Returns the usable runs of files. Reports every other line, and the fate of its run if `wanted`
/// runs of each row are to be made. A missing file has no runs.
///
/// If two lines contradict each other, neither is used: nothing says which is right.
pub(super) fn read<'a>(
    files: impl IntoIterator<Item = &'a Path>,
    experiment: &Experiment,
    master_seed: u64,
    wanted: u32,
    progress: &dyn Progress,
) -> Result<Runs, Error> {
    let mut runs = Runs::new();
    let mut disputed = BTreeSet::new();
    let mut broken = Vec::new();
    for file in files {
        let Some(bytes) = if_there("read", file, fs::read(file))? else {
            continue;
        };
        for (line, text) in (1..).zip(bytes.split(|&byte| byte == b'\n')) {
            if text.is_empty() {
                continue;
            }
            let (what, key) = match parse(text, experiment, master_seed) {
                Ok((key, run)) => match runs.entry(key) {
                    Entry::Vacant(entry) => {
                        entry.insert(run);
                        continue;
                    }
                    Entry::Occupied(entry) if *entry.get() == run => continue,
                    Entry::Occupied(_) => {
                        disputed.insert(key);
                        ("it contradicts an earlier line".to_owned(), Some(key))
                    }
                },
                Err(refused) => refused,
            };
            broken.push(Broken {
                file,
                line,
                what,
                key,
            });
        }
    }
    runs.retain(|key, _| !disputed.contains(key));
    tell(&broken, &runs, experiment, wanted, progress);
    Ok(runs)
}

fn tell(
    broken: &[Broken<'_>],
    runs: &Runs,
    experiment: &Experiment,
    wanted: u32,
    progress: &dyn Progress,
) {
    let rows = experiment.tables.iter().flat_map(|table| &table.rows);
    let all: u64 = rows.map(|row| u64::from(row.runs_of(wanted))).sum();
    let is_wanted = |key: &Key| is_wanted(*key, experiment, wanted);
    let complete = runs.keys().filter(|key| is_wanted(key)).count() as u64 == all;
    for Broken {
        file,
        line,
        what,
        key,
    } in broken
    {
        let remedy = match key {
            Some(key) if is_wanted(key) && !runs.contains_key(key) => Remedy::PlayedAgain,
            None if !complete => Remedy::MissingPlayed,
            _ => Remedy::Ignored,
        };
        progress.event(&ProgressEvent::BrokenLine {
            file,
            line: *line,
            what,
            remedy,
        });
    }
}

/// Returns whether a run is among those to make, with `runs` of each row.
pub(super) fn is_wanted((table, row, run): Key, experiment: &Experiment, runs: u32) -> bool {
    let table = experiment.tables.get(table);
    let row = table.and_then(|table| table.rows.get(row));
    row.is_some_and(|row| run < row.runs_of(runs))
}

/// Returns the run of a line; or the fault of the line, with its run if known.
fn parse(
    line: &[u8],
    experiment: &Experiment,
    master: u64,
) -> Result<(Key, Run), (String, Option<Key>)> {
    let (run, intact) = read_line::<Run>(line).map_err(|error| {
        // The parser saw a single line, so its line number is not that of the file.
        let what = error.to_string();
        let what = what.split(" at line ").next().unwrap_or_default();
        (
            format!("{what} at column {}", error.column()),
            identity(line, experiment),
        )
    })?;
    let key = key_of(experiment, &run).ok_or_else(|| {
        let what = format!("there is no row {:?} in a table {:?}", run.row, run.table);
        (what, None)
    })?;
    let seed = run_seed(master, &run.table, run.run);
    if run.seed != seed {
        let what = format!("run {} has seed {} where {seed} belongs", run.run, run.seed);
        return Err((what, Some(key)));
    }
    let sound = || check::run(experiment, &run).map_err(|error| error.to_string());
    match intact.and_then(|()| sound()) {
        Ok(()) => Ok((key, run)),
        Err(what) => Err((what, Some(key))),
    }
}

/// Returns the run of a line whose fields are invalid; `None` if it is not known.
fn identity(line: &[u8], experiment: &Experiment) -> Option<Key> {
    let mut line: serde_json::Value = serde_json::from_slice(line).ok()?;
    line.as_object_mut()?
        .retain(|name, _| check::RESERVED.contains(&name.as_str()));
    key_of(experiment, &serde_json::from_value(line).ok()?)
}

fn key_of(experiment: &Experiment, run: &Run) -> Option<Key> {
    let mut tables = experiment.tables.iter().enumerate();
    let (number, table) = tables.find(|(_, table)| table.name == run.table)?;
    let row = table.rows.iter().position(|row| row.name == run.row)?;
    Some((number, row, run.run))
}

/// Writes a whole file of lines, in order.
pub(super) fn write<'a, R: Serialize + 'a>(
    path: &Path,
    runs: impl Iterator<Item = &'a R>,
) -> Result<(), Error> {
    let mut text = Vec::new();
    for run in runs {
        at("write", path, write_line(&mut text, run))?;
    }
    write_whole(path, &text)
}

fn write_line(out: &mut Vec<u8>, run: &impl Serialize) -> io::Result<()> {
    let checksum = Some(checksum_of(run)?);
    serde_json::to_writer(&mut *out, &Line { run, checksum })?;
    out.push(b'\n');
    Ok(())
}

/// A file to which several threads append lines.
#[derive(Debug)]
pub(super) struct Appender {
    path: PathBuf,
    file: Mutex<File>,
}

impl Appender {
    /// Opens an existing file.
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
        let file = at("open", path, OpenOptions::new().append(true).open(path))?;
        Ok(Self {
            path: path.to_owned(),
            file: Mutex::new(file),
        })
    }

    /// Appends one run or picture. The line is handed to the system at once, so it survives the end
    /// of this process.
    pub(super) fn append(&self, run: &impl Serialize) -> Result<(), Error> {
        let mut line = Vec::new();
        let written = write_line(&mut line, run).and_then(|()| {
            // A thread that panicked while it held the file left a whole line or a broken one. The
            // next reading reports the latter.
            let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
            file.write_all(&line)
        });
        at("add a line to", &self.path, written)
    }
}
