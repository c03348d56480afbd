//! The mazes that one argument names, and what is done with all of them.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use indicatif::{ParallelProgressIterator, ProgressBar};
use rayon::prelude::*;
use tolman_maze::{Maze, MazeFile};

use super::input;
use crate::cli::{Failure, failure::note};

/// The sound mazes of a file or a folder, by name, and what is to be said of the others.
pub(in crate::cli) struct Collection {
    pub(in crate::cli) mazes: Vec<(PathBuf, Maze)>,
    pub(in crate::cli) unsound: Unsound,
}

impl Collection {
    /// Reads all mazes for mice that a path names. Those for robots in a folder are skipped with a
    /// line on stderr: whoever wants one names its file.
    ///
    /// # Errors
    /// If it names none.
    pub(in crate::cli) fn read(path: &Path) -> Result<Self, Failure> {
        let mut mazes = Vec::new();
        let mut unsound = Unsound::default();
        for file in input::files(path)? {
            match input::read(&file) {
                Ok(read) => match for_robots(&read) {
                    Some(reason) if path.is_dir() => {
                        let name = input::name(&file);
                        note(&format!("{name} is a maze for robots ({reason}): skipped"));
                    }
                    _ => mazes.push((file, read.maze)),
                },
                Err(failure) => unsound.push(failure),
            }
        }
        if mazes.is_empty() && unsound.len() == 0 {
            return Err(Failure::BadInput(anyhow!(
                "{} holds no maze for a mouse: name a folder of such mazes, or a file",
                path.display()
            )));
        }
        Ok(Self { mazes, unsound })
    }
}

/// Returns why a maze is one for robots, if it is: a mouse's has a start, and cells as wide as the
/// rules say.
fn for_robots(file: &MazeFile) -> Option<&'static str> {
    if file.corridor_width.is_some() {
        return Some("it says how wide its corridors are");
    }
    file.maze.start().is_none().then_some("it marks no start")
}

/// Lets `work` happen to each maze, `jobs` at a time or one a core, behind a progress bar. The
/// results are in the order of the mazes.
///
/// # Errors
/// What `work` fails with, or if no threads can be started.
pub(in crate::cli) fn each<'a, T: Send>(
    mazes: &'a [(PathBuf, Maze)],
    jobs: Option<u16>,
    work: impl Fn(&'a Path, &'a Maze) -> Result<T, Failure> + Sync,
) -> Result<Vec<T>, Failure> {
    // A single one may be drawn on the terminal meanwhile, which this thread holds.
    if let [(file, maze)] = mazes {
        return Ok(vec![work(file, maze)?]);
    }
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs.map_or(0, usize::from))
        .build()
        .context("no threads can be started")?;
    let bar = ProgressBar::new(mazes.len() as u64);
    threads.install(|| {
        mazes
            .par_iter()
            // Mazes differ much, and the last must not leave the other cores idle.
            .with_max_len(1)
            .progress_with(bar)
            .map(|(file, maze)| work(file, maze))
            .collect()
    })
}

/// Fails if the mouse did not solve some of the mazes, each a file and whether it did. A single one
/// is named.
///
/// # Errors
/// A failure.
pub(in crate::cli) fn all_solved<'a>(
    tried: impl Iterator<Item = (&'a Path, bool)>,
) -> Result<(), Failure> {
    let (solved, unsolved): (Vec<_>, Vec<_>) = tried.partition(|(_, solved)| *solved);
    let which = match (&unsolved[..], &solved[..]) {
        ([], _) => return Ok(()),
        ([(only, _)], []) => input::name(only),
        _ => {
            let all = solved.len() + unsolved.len();
            format!("{} of {all} mazes", unsolved.len())
        }
    };
    Err(Failure::Failed(anyhow!("the mouse did not solve {which}")))
}

/// What went wrong with the mazes that cannot be used.
#[derive(Default)]
pub(in crate::cli) struct Unsound(Vec<Failure>);

impl Unsound {
    pub(in crate::cli) fn push(&mut self, failure: Failure) {
        self.0.push(failure);
    }

    /// Keeps what went wrong, and returns what did not.
    pub(in crate::cli) fn sift<T>(
        &mut self,
        outcomes: Vec<Result<T, Failure>>,
    ) -> impl Iterator<Item = T> {
        let sift = |outcome| match outcome {
            Ok(sound) => Some(sound),
            Err(failure) => {
                self.push(failure);
                None
            }
        };
        outcomes.into_iter().filter_map(sift)
    }

    /// Returns how many there are.
    pub(in crate::cli) fn len(&self) -> usize {
        self.0.len()
    }

    /// Complains of each, and fails if there are any. A single maze that is alone speaks for
    /// itself.
    pub(in crate::cli) fn complain(mut self, sound: usize) -> Result<(), Failure> {
        let (bad, all) = (self.len(), self.len() + sound);
        if all == 1
            && let Some(only) = self.0.pop()
        {
            return Err(only);
        }
        if bad == 0 {
            return Ok(());
        }
        self.0.iter().for_each(Failure::complain);
        Err(Failure::BadInput(anyhow!(
            "{bad} of {all} mazes are invalid"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsound_mazes_are_counted() {
        let complain = |failures: Vec<Failure>, sound| Unsound(failures).complain(sound);
        let failure = complain(vec![Failure::BadInput(anyhow!("torn"))], 0);
        assert!(matches!(failure, Err(Failure::BadInput(error)) if error.to_string() == "torn"));
        assert!(complain(Vec::new(), 3).is_ok());
        let failure = complain(vec![Failure::BadInput(anyhow!("torn"))], 3);
        assert!(
            matches!(failure, Err(Failure::BadInput(error)) if error.to_string() == "1 of 4 mazes are invalid")
        );
    }
}
