//! Choices of the caller.

use std::env;
use std::path::{Path, PathBuf};
use std::thread;

use super::{Beside, Chunk, Entry, Headline};
use crate::shell::quoted;

/// Program that the caller runs experiments with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// The installed program of this name.
    Command(&'static str),
    /// `cargo xtask`, in the project's own folder.
    Xtask,
}

/// Name of this project's own program.
const OWN: &str = "tolman";

impl Default for Program {
    fn default() -> Self {
        Self::Command(OWN)
    }
}

impl Program {
    /// Returns the running program, which is called `command`. If the variable `CARGO` says that
    /// cargo started it, it is `cargo xtask`.
    pub fn current(command: &'static str) -> Self {
        match env::var_os("CARGO") {
            Some(_) if command == OWN => Self::Xtask,
            _ => Self::Command(command),
        }
    }

    /// Returns the first words of a command line.
    #[must_use]
    pub const fn command(self) -> &'static str {
        match self {
            Self::Command(command) => command,
            Self::Xtask => "cargo xtask",
        }
    }
}

/// Options of running an experiment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Master seed, from which every run's seed follows. Below 2^63, because of TOML.
    pub seed: u64,
    /// Number of runs of each row, at most [`Self::MOST_RUNS`]; `None` for the experiment's own
    /// number.
    pub runs: Option<u32>,
    /// Number of threads, at most [`Self::MOST_JOBS`] and at most the number of runs; `None` for
    /// one per core. Results do not depend on it.
    pub jobs: Option<u32>,
    /// Maze files to use instead of the experiment's own worlds.
    pub mazes: Vec<PathBuf>,
    /// Number of time steps after which a run has failed, where runs have such a limit; `None` for
    /// the experiment's own. If it differs from the paper's, the paper's values are left out.
    pub limit: Option<u32>,
    /// Folder of results; `None` for `results/NAME` in the current folder.
    pub out: Option<PathBuf>,
    /// Names of the tables to fill; empty for all.
    pub tables: Vec<String>,
    /// Names of the rows to fill, in each table that has them; empty for all.
    pub rows: Vec<String>,
    /// Whether to play few runs, for a first look.
    pub quick: bool,
    /// Ray caster of the worlds, as the option `--caster` names it; `None` for the usual one.
    pub caster: Option<&'static str>,
    /// Program that the command to repeat the results begins with.
    pub program: Program,
}

impl Options {
    /// Maximum number of runs of each row. Every run is kept in memory, about 1 kB each, until all
    /// are summarized.
    pub const MOST_RUNS: u32 = 100_000;

    /// Maximum number of threads. More would not help, and each takes memory.
    pub const MOST_JOBS: u32 = 256;

    /// Returns the number of runs of each row: the caller's, or else the experiment's, quick or
    /// full.
    pub fn runs_of(&self, entry: &Entry) -> u32 {
        self.runs.unwrap_or(match self.quick {
            true => entry.quick_runs,
            false => entry.runs,
        })
    }

    /// Returns the number of runs for a row whose number differs from the experiment's: the
    /// caller's, or else `full` or `quick`.
    pub fn runs_else(&self, full: u32, quick: u32) -> u32 {
        self.runs.unwrap_or(if self.quick { quick } else { full })
    }

    /// Returns the options for a line of the tour, with its own folder.
    #[must_use]
    pub fn on_tour(&self, line: &Headline, folder: &Path) -> Self {
        let rival = match line.beside {
            Beside::Rival { row, .. } => Some(row),
            Beside::Paper | Beside::Nothing => None,
        };
        let rows = [Some(line.row), rival].into_iter().flatten();
        Self {
            runs: line.runs,
            quick: line.runs.is_none(),
            tables: vec![line.table.to_owned()],
            rows: rows.map(str::to_owned).collect(),
            out: Some(folder.to_owned()),
            ..self.clone()
        }
    }

    /// Returns the number of threads for this many runs.
    pub(super) fn threads_for(&self, runs: u64) -> u32 {
        let wanted = self.jobs.unwrap_or_else(|| {
            thread::available_parallelism()
                .ok()
                .and_then(|cores| u32::try_from(cores.get()).ok())
                .unwrap_or(1)
        });
        let useful = u32::try_from(runs).unwrap_or(u32::MAX);
        wanted.min(useful).clamp(1, Self::MOST_JOBS)
    }

    /// Returns the folder for an experiment's results.
    pub fn folder_of(&self, name: &str) -> PathBuf {
        self.out
            .clone()
            .unwrap_or_else(|| PathBuf::from("results").join(name))
    }

    /// Returns the command that repeats the results.
    pub fn command_of(&self, entry: &Entry) -> String {
        let verb = format!("{} experiment {}", self.program.command(), entry.name);
        self.command(&verb, entry)
    }

    /// Returns the command that continues a chunk.
    pub(super) fn command_of_chunk(&self, entry: &Entry, chunk: Chunk) -> String {
        let program = match self.program {
            Program::Command(command) => command,
            Program::Xtask => OWN,
        };
        let verb = format!(
            "{program} trial --experiment {} --chunk {chunk}",
            entry.name
        );
        self.command(&verb, entry)
    }

    /// Returns a command with this verb and all options that the results depend on.
    fn command(&self, verb: &str, entry: &Entry) -> String {
        let mut command = format!("{verb} --seed {}", self.seed);
        // A table named alone may have a fixed number of runs.
        if self.runs.is_some() || self.tables.is_empty() {
            command += &format!(" --runs {}", self.runs_of(entry));
        }
        if self.quick {
            command += " --quick";
        }
        if let Some(caster) = self.caster {
            command += &format!(" --caster {caster}");
        }
        if let Some(limit) = self.limit {
            command += &format!(" --limit {limit}");
        }
        for table in &self.tables {
            command += &format!(" --table {}", quoted(table));
        }
        for row in &self.rows {
            command += &format!(" --row {}", quoted(row));
        }
        for maze in &self.mazes {
            command += &format!(" --maze {}", quoted(&maze.to_string_lossy()));
        }
        if let Some(out) = &self.out {
            command += &format!(" --out {}", quoted(&out.to_string_lossy()));
        }
        command
    }
}

#[cfg(test)]
mod tests {
    use super::Options;

    #[test]
    fn threads_are_as_many_as_help() {
        let threads = |jobs, runs| {
            let options = Options {
                jobs,
                ..Options::default()
            };
            options.threads_for(runs)
        };
        for (jobs, runs, expect) in [
            (2, 100, 2),
            (100, 3, 3),
            (100, 0, 1),
            (u32::MAX, u64::MAX, Options::MOST_JOBS),
        ] {
            assert_eq!(threads(Some(jobs), runs), expect, "{jobs} for {runs}");
        }
        assert!((1..=Options::MOST_JOBS).contains(&threads(None, 1000)));
    }
}
