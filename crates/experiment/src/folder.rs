//! The folder of results. Only one process may open it at a time. It is resumed for the same
//! experiment, and set aside for another.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use super::at::{at, if_there, make_folder, write_whole};
use super::config_file::ConfigFile;
use super::pictures::Pictures;
use super::runs_file::{self, Appender, Runs};
use super::{Chunk, Error, Experiment, Progress, ProgressEvent, Run};
use tolman_draw::Figure;

pub(super) const CONFIG: &str = "config.toml";
pub(super) const RUNS: &str = "runs.jsonl";
/// File of finished runs beyond the number asked for, kept in case more are asked for later.
const SPARE: &str = "spare.jsonl";
/// An empty file that is locked while a process has the folder open. It is never removed: otherwise
/// two processes could lock two files of the same name.
const LOCK: &str = ".lock";

/// Folder of single replays, which may exist before any run was played.
pub(super) const REPLAYS: &str = "replays";

/// An open folder of results. No other process can open it until this is dropped.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// Lock file. It is kept open because closing it would release the lock.
    _lock: File,
}

impl Folder {
    /// Opens or makes the folder for the experiment that `config` describes, and writes its
    /// `config.toml`. Results of another configuration are moved to `PATH.1`, `PATH.2`, ….
    pub(super) fn open(
        path: &Path,
        config: &ConfigFile,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        let text = config.text()?;
        refuse_foreign(path)?;
        make_folder(path)?;
        let mut lock = lock(path)?;
        if let Some(reason) = conflict(path, config)? {
            let moved_to = free_name(path);
            at("move aside", path, fs::rename(path, &moved_to))?;
            progress.event(&ProgressEvent::SetAside {
                folder: path,
                moved_to: &moved_to,
                reason: &reason,
            });
            make_folder(path)?;
            lock = self::lock(path)?;
        }
        write_whole(&path.join(CONFIG), text.as_bytes())?;
        Ok(Self {
            path: path.to_owned(),
            _lock: lock,
        })
    }

    /// Reads the finished runs. Those below `runs` stay in `runs.jsonl`, the others go to
    /// `spare.jsonl`. Returns the former.
    pub(super) fn resume(
        &self,
        experiment: &Experiment,
        master_seed: u64,
        runs: u32,
        progress: &dyn Progress,
    ) -> Result<Runs, Error> {
        let (file, spare_file) = (self.path.join(RUNS), self.path.join(SPARE));
        let files = [file.as_path(), &spare_file];
        let known = runs_file::read(files, experiment, master_seed, runs, progress)?;
        let (kept, spare): (Runs, Runs) = known
            .into_iter()
            .partition(|(key, _)| runs_file::is_wanted(*key, experiment, runs));
        // Spare runs are on the disk before they are removed from the other file.
        if !spare.is_empty() {
            runs_file::write(&spare_file, spare.values())?;
        }
        runs_file::write(&file, kept.values())?;
        if spare.is_empty() {
            self.discard(SPARE)?;
        }
        Ok(kept)
    }

    /// Opens `runs.jsonl` to append finished runs.
    pub(super) fn appender(&self) -> Result<Appender, Error> {
        Appender::open(&self.path.join(RUNS))
    }

    /// Writes the finished `runs.jsonl`, in order.
    pub(super) fn write_runs(&self, runs: &[Run]) -> Result<(), Error> {
        runs_file::write(&self.path.join(RUNS), runs.iter())
    }

    /// Opens `pictures.jsonl`, for figures of these runs and for replays.
    pub(super) fn pictures(&self, runs: &[Run]) -> Result<Pictures, Error> {
        Pictures::open(&self.path.join("pictures.jsonl"), runs)
    }

    /// Writes every figure to `figures/NAME.svg` and removes older ones.
    pub(super) fn write_figures(&self, figures: &[Figure]) -> Result<(), Error> {
        let folder = self.path.join("figures");
        make_folder(&folder)?;
        let names: Vec<String> = figures
            .iter()
            .map(|figure| format!("{}.svg", figure.name))
            .collect();
        for entry in at("read the folder", &folder, fs::read_dir(&folder))? {
            let path = at("read the folder", &folder, entry)?.path();
            let stale = path.extension().is_some_and(|extension| extension == "svg")
                && !names.iter().any(|name| path.ends_with(name));
            if stale {
                at("remove", &path, fs::remove_file(&path))?;
            }
        }
        for (figure, name) in figures.iter().zip(&names) {
            write_whole(&folder.join(name), figure.standalone().as_bytes())?;
        }
        Ok(())
    }

    /// Removes a file of the folder, if it is there.
    pub(super) fn discard(&self, name: &str) -> Result<(), Error> {
        let path = self.path.join(name);
        if_there("remove", &path, fs::remove_file(&path))?;
        Ok(())
    }

    /// Writes a file of the folder.
    pub(super) fn write(&self, name: &str, contents: &str) -> Result<(), Error> {
        write_whole(&self.path.join(name), contents.as_bytes())
    }
}

/// Refuses a path that is a file, and a folder with files but without our `config.toml`, so that
/// nobody's files are moved or overwritten.
fn refuse_foreign(path: &Path) -> Result<(), Error> {
    let Some(entries) = if_there("read the folder", path, fs::read_dir(path))? else {
        return Ok(());
    };
    let config = path.join(CONFIG);
    if config.is_file() {
        let text = at("read", &config, fs::read_to_string(&config))?;
        return match ConfigFile::parse(&text) {
            Some(_) => Ok(()),
            None => Err(foreign(path, "its config.toml is of another kind")),
        };
    }
    for entry in entries {
        let name = at("read the folder", path, entry)?.file_name();
        let name = name.to_string_lossy();
        // Allowed are the remains of a process that died early, single replays, and chunks to
        // merge.
        let ours = name == LOCK
            || name == REPLAYS
            || (name.starts_with('.') && name.ends_with(".tmp"))
            || Chunk::of_folder(&name).is_some();
        if !ours {
            return Err(foreign(
                path,
                &format!("for one {name}, and no config.toml"),
            ));
        }
    }
    Ok(())
}

fn foreign(path: &Path, what: &str) -> Error {
    Error::ForeignFolder {
        folder: path.to_owned(),
        what: what.to_owned(),
    }
}

fn lock(path: &Path) -> Result<File, Error> {
    let name = path.join(LOCK);
    let file = OpenOptions::new()
        .create(true)
        .write(true)
        .truncate(false)
        .open(&name);
    let file = at("open", &name, file)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(Error::Busy {
            folder: path.to_owned(),
        }),
        Err(TryLockError::Error(error)) => at("lock", &name, Err(error)),
    }
}

/// Returns why the contents of the folder cannot be combined with the new results; `None` if they
/// can.
pub(super) fn conflict(path: &Path, config: &ConfigFile) -> Result<Option<String>, Error> {
    let file = path.join(CONFIG);
    let text = if_there("read", &file, fs::read_to_string(&file))?;
    Ok(text.and_then(|text| match ConfigFile::parse(&text) {
        Some(former) => config.conflict_with(&former),
        None => Some("a config.toml that cannot be read".to_owned()),
    }))
}

/// Returns the first unused path of `PATH.1`, `PATH.2`, ….
fn free_name(path: &Path) -> PathBuf {
    let mut number = 1_u64;
    // Remove a slash at the end of the path.
    let path: PathBuf = path.components().collect();
    loop {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{number}"));
        let name = PathBuf::from(name);
        if !name.exists() {
            return name;
        }
        number += 1;
    }
}
