//! The mazes that one argument names, and what is done with all of them.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use indicatif::{ParallelProgressIterator, ProgressBar};
use rayon::prelude::*;
use tolman_maze::{Maze, MazeFile};

use super::input;
use crate::cli::Failure;

/// The sound mazes of a file or a folder, by name, and what is to be said of the others.
pub(in crate::cli) struct Collection {
    pub(in crate::cli) mazes: Vec<(PathBuf, Maze)>,
    pub(in crate::cli) unsound: Unsound,
}

impl Collection {
    /// Reads all files that a path names.
    ///
    /// # Errors
    /// If it names none.
    pub(in crate::cli) fn read(path: &Path) -> Result<Self, Failure> {
        let mut mazes = Vec::new();
        let mut unsound = Unsound::default();
        for file in input::files(path)? {
            match input::read(&file) {
                Ok(MazeFile { maze, .. }) => mazes.push((file, maze)),
                Err(failure) => unsound.push(failure),
            }
        }
        Ok(Self { mazes, unsound })
    }
}

/// Lets `work` happen to each maze, `jobs` at a time or one a core, behind a progress bar. The results are in the order of
/// the mazes.
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

/// Fails if the mouse did not solve some of the mazes. A single one is named.
///
/// # Errors
/// A failure.
pub(in crate::cli) fn all_solved(
    mazes: &[(PathBuf, Maze)],
    solved: impl Iterator<Item = bool>,
) -> Result<(), Failure> {
    let tried = mazes.iter().zip(solved);
    let unsolved: Vec<_> = tried.filter(|(_, solved)| !solved).collect();
    let which = match (&unsolved[..], mazes) {
        ([], _) => return Ok(()),
        (_, [(only, _)]) => input::name(only),
        _ => format!("{} of {} mazes", unsolved.len(), mazes.len()),
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

    /// How many there are.
    pub(in crate::cli) fn len(&self) -> usize {
        self.0.len()
    }

    /// Complains of each, and fails if there are any. A single maze that is alone speaks for itself.
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
            "{bad} of {all} mazes are unsound"
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
            matches!(failure, Err(Failure::BadInput(error)) if error.to_string() == "1 of 4 mazes are unsound")
        );
    }
}
