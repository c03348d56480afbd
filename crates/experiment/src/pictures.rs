//! `pictures.jsonl`: what is made after the last run. Each figure and each replay has a line, which
//! is appended when it is finished, so an interrupted experiment makes it only once.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use tolman_draw::{Drawing, Figure};

use super::at::{at, if_there};
use super::hash::fnv64;
use super::runs_file::{self, Appender};
use super::{BoxError, Error, Job, Run};

/// A line of the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Picture {
    key: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    figures: Vec<KeptFigure>,
    /// Input of the player; `None` if the run has nothing to show.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    replay: Option<String>,
}

/// A figure as text and numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct KeptFigure {
    name: String,
    title: String,
    caption: String,
    table: Option<String>,
    width: f64,
    height: f64,
    description: String,
    body: String,
}

/// The finished figures and replays of a folder.
#[derive(Debug)]
pub(super) struct Pictures {
    path: PathBuf,
    file: Appender,
    /// Hash of the runs that the figures show.
    runs: String,
    known: BTreeMap<String, Picture>,
    /// Pictures that were used since the file was opened.
    used: Mutex<BTreeMap<String, Picture>>,
}

impl Pictures {
    /// Opens the file, and makes it if it is not there. A line that is broken is not used, so its
    /// picture is made again.
    pub(super) fn open(path: &Path, runs: &[Run]) -> Result<Self, Error> {
        let bytes = if_there("read", path, fs::read(path))?.unwrap_or_default();
        let lines = bytes.split(|&byte| byte == b'\n');
        let intact = lines.filter_map(|line| match runs_file::read_line::<Picture>(line) {
            Ok((picture, Ok(()))) => Some((picture.key.clone(), picture)),
            _ => None,
        });
        let known = intact.collect();
        at(
            "make",
            path,
            OpenOptions::new().create(true).append(true).open(path),
        )?;
        let runs = at("hash the runs for", path, hash_of(runs))?;
        Ok(Self {
            path: path.to_owned(),
            file: Appender::open(path)?,
            runs,
            known,
            used: Mutex::default(),
        })
    }

    /// Returns the figures of this name. `draw` is called only if they are not known.
    pub(super) fn figures(
        &self,
        name: &str,
        draw: impl FnOnce() -> Result<Vec<Figure>, BoxError>,
    ) -> Result<Vec<Figure>, BoxError> {
        let made = self.picture(format!("figures {name} of runs {}", self.runs), |key| {
            Ok::<_, BoxError>(Picture {
                key,
                figures: draw()?.into_iter().map(KeptFigure::from).collect(),
                replay: None,
            })
        })?;
        Ok(made.figures.into_iter().map(Figure::from).collect())
    }

    /// Returns the replay of a run. `record` is called only if it is not known.
    pub(super) fn replay(
        &self,
        job: &Job<'_>,
        record: impl FnOnce() -> Result<Option<String>, Error>,
    ) -> Result<Option<String>, Error> {
        let key = format!("replay of run {} of {} in {}", job.run, job.row, job.table);
        let made = self.picture(key, |key| {
            Ok::<_, Error>(Picture {
                key,
                figures: Vec::new(),
                replay: record()?,
            })
        })?;
        Ok(made.replay)
    }

    fn picture<E: From<Error>>(
        &self,
        key: String,
        make: impl FnOnce(String) -> Result<Picture, E>,
    ) -> Result<Picture, E> {
        let picture = match self.known.get(&key) {
            Some(known) => known.clone(),
            None => {
                let made = make(key.clone())?;
                self.file.append(&made)?;
                made
            }
        };
        let mut used = self.used.lock().unwrap_or_else(PoisonError::into_inner);
        used.insert(key, picture.clone());
        Ok(picture)
    }

    /// Writes the finished file: the pictures that were used, in order.
    pub(super) fn finish(self) -> Result<(), Error> {
        let used = self.used.into_inner();
        let used = used.unwrap_or_else(PoisonError::into_inner);
        runs_file::write(&self.path, used.values())
    }
}

fn hash_of(runs: &[Run]) -> std::io::Result<String> {
    Ok(format!("{:016x}", fnv64(&serde_json::to_vec(runs)?)))
}

impl From<Figure> for KeptFigure {
    fn from(figure: Figure) -> Self {
        let Figure {
            name,
            title,
            caption,
            table,
            drawing,
        } = figure;
        Self {
            name,
            title,
            caption,
            table,
            width: drawing.width,
            height: drawing.height,
            description: drawing.description,
            body: drawing.body.into_string(),
        }
    }
}

impl From<KeptFigure> for Figure {
    fn from(kept: KeptFigure) -> Self {
        let drawing = Drawing {
            width: kept.width,
            height: kept.height,
            description: kept.description,
            body: maud::PreEscaped(kept.body),
        };
        Self {
            name: kept.name,
            title: kept.title,
            caption: kept.caption,
            table: kept.table,
            drawing,
        }
    }
}
