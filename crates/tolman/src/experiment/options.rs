//! What the caller chooses.

use std::path::PathBuf;

use super::Experiment;

/// How an experiment is run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The master seed, from which every run's seed is derived. Below 2^63, for TOML.
    pub seed: u64,
    /// Runs of each row, at most [`Self::MOST_RUNS`]; `None` takes the experiment's own number.
    pub runs: Option<u32>,
    /// Threads; `None` takes one for each core. Results do not depend on it.
    pub jobs: Option<u32>,
    /// Maze files that take the place of the experiment's own worlds.
    pub mazes: Vec<PathBuf>,
    /// The folder of results; `None` is `results/NAME` under the current folder.
    pub out: Option<PathBuf>,
    /// Few runs, for a first look.
    pub quick: bool,
}

impl Options {
    /// The most runs of each row: every run is kept in memory, about 1 kB each, until all are
    /// summarized.
    pub const MOST_RUNS: u32 = 100_000;

    /// Runs of each row: the caller's number, else the experiment's, quick or full.
    pub fn runs_of(&self, experiment: &dyn Experiment) -> u32 {
        self.runs.unwrap_or_else(|| match self.quick {
            true => experiment.quick_runs(),
            false => experiment.default_runs(),
        })
    }

    /// The folder the results of an experiment go to.
    pub fn folder_of(&self, name: &str) -> PathBuf {
        self.out
            .clone()
            .unwrap_or_else(|| PathBuf::from("results").join(name))
    }

    /// The command that makes the same results again.
    pub fn command_of(&self, name: &str, experiment: &dyn Experiment) -> String {
        let mut command = format!(
            "cargo xtask experiment {name} --seed {} --runs {}",
            self.seed,
            self.runs_of(experiment)
        );
        if self.quick {
            command += " --quick";
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

/// An argument as a shell takes it: in single quotes if it holds anything unusual.
fn quoted(argument: &str) -> String {
    let usual = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(usual) {
        argument.to_owned()
    } else {
        format!("'{}'", argument.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn arguments_survive_the_shell() {
        for (argument, expect) in [
            ("a/b.txt", "a/b.txt"),
            ("my maze", "'my maze'"),
            ("it's", r"'it'\''s'"),
            ("", "''"),
        ] {
            assert_eq!(quoted(argument), expect);
        }
    }
}
