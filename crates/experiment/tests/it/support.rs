//! Temporary folders, and a listener.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicU64, Ordering};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use tolman_experiment::{
    Build, Error, Experiment, ExperimentOutcome, Options, Progress, ProgressEvent, execute,
};

/// Returns an empty folder for one test.
pub(crate) fn fresh(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("experiments")
        .join(test);
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&folder).unwrap();
    folder
}

pub(crate) fn build() -> Build {
    Build {
        commit: "0123456789".into(),
        compiler: "rustc 1.95.0 (test)".into(),
        executable: "00".into(),
    }
}

pub(crate) fn options(out: &Path) -> Options {
    Options {
        seed: 7,
        runs: Some(40),
        jobs: Some(2),
        out: Some(out.to_owned()),
        ..Options::default()
    }
}

/// Records what it hears, and stops after some runs.
#[derive(Default)]
pub(crate) struct Listener {
    pub(crate) messages: Mutex<Vec<String>>,
    played: AtomicU64,
    stop_after: Option<u64>,
    /// Counter of figures and replays, and the number after which to stop.
    stop_at: Option<(Arc<AtomicU64>, u64)>,
}

impl Listener {
    pub(crate) fn stopping_after(runs: u64) -> Self {
        Self {
            stop_after: Some(runs),
            ..Self::default()
        }
    }

    pub(crate) fn stopping_at(made: &Arc<AtomicU64>, limit: u64) -> Self {
        Self {
            stop_at: Some((Arc::clone(made), limit)),
            ..Self::default()
        }
    }

    pub(crate) fn played(&self) -> u64 {
        self.played.load(Ordering::SeqCst)
    }

    pub(crate) fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap().clone()
    }
}

impl Progress for Listener {
    fn event(&self, event: &ProgressEvent<'_>) {
        let message = match event {
            ProgressEvent::RunFinished => {
                self.played.fetch_add(1, Ordering::SeqCst);
                return;
            }
            ProgressEvent::SetAside {
                moved_to, reason, ..
            } => {
                format!("{} has {reason}", moved_to.file_name().unwrap().display())
            }
            ProgressEvent::BrokenLine {
                file,
                line,
                what,
                remedy,
            } => {
                let file = file.file_name().unwrap().display();
                format!("{file}:{line}: {what}; {remedy:?}")
            }
            ProgressEvent::Started { total, reused } => format!("{reused} of {total}"),
            _ => return,
        };
        self.messages.lock().unwrap().push(message);
    }

    fn stop_requested(&self) -> bool {
        let made = self.stop_at.as_ref();
        self.stop_after.is_some_and(|limit| self.played() >= limit)
            || made.is_some_and(|(made, limit)| made.load(Ordering::SeqCst) >= *limit)
    }
}

/// Runs an experiment and returns what was heard.
pub(crate) fn run(
    experiment: impl Into<Experiment>,
    options: &Options,
) -> (Result<ExperimentOutcome, Error>, Listener) {
    let listener = Listener::default();
    (
        execute(&experiment.into(), options, &build(), &listener),
        listener,
    )
}

pub(crate) fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}
