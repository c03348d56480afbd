//! The mazes that one argument names, and work on all of them.

use alloc::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc;

use anyhow::{Context, anyhow};
use indicatif::ProgressBar;
use rayon::prelude::*;
use tolman_maze::{Cell, Direction, Maze, MazeFile};

use super::marks::Marks;
use super::{OrBadInput, input};
use crate::cli::bar::busy;
use crate::cli::looks::Looks;
use crate::cli::{Failure, Result, failure::note};

/// The valid mazes of a file or a folder, by name, and the failures of the others.
pub(in crate::cli) struct Collection {
    pub(in crate::cli) mazes: Vec<(PathBuf, Maze)>,
    /// Mazes with unknown walls.
    pub(in crate::cli) half_known: Vec<(PathBuf, MazeFile)>,
    pub(in crate::cli) unsound: Unsound,
}

impl Collection {
    /// Reads all mazes for mice that a path names. Mazes for robots in a folder are skipped with a
    /// line on stderr; name the file to use one.
    ///
    /// # Errors
    /// If there is no maze for mice, or `looks` asks to show one run and there are several.
    pub(in crate::cli) fn read(path: &Path, marks: Option<&Marks>, looks: &Looks) -> Result<Self> {
        let (mut mazes, mut half_known) = (Vec::new(), Vec::new());
        let mut unsound = Unsound::default();
        for file in input::files(path)? {
            match marked(&file, marks) {
                Ok(mut read) => match for_robots(&read) {
                    Some(reason) if path.is_dir() => {
                        let name = input::name(&file);
                        note(&format!("{name} is a maze for robots ({reason}): skipped"));
                    }
                    _ => {
                        // As in contests of mice.
                        let start = read
                            .maze
                            .start()
                            .unwrap_or((Cell::new(0, 0), Direction::North));
                        read.maze.set_start(Some(start));
                        if read.goal_is_assumed {
                            let name = input::name(&file);
                            note(&format!(
                                "{name} marks no goal: the middle is taken; --goal gives another"
                            ));
                        }
                        match read.unknown.is_empty() {
                            true => mazes.push((file, read.maze)),
                            false => half_known.push((file, read)),
                        }
                    }
                },
                Err(failure) => unsound.push(failure),
            }
        }
        if mazes.is_empty() && half_known.is_empty() && unsound.len() == 0 {
            return Err(Failure::BadInput(anyhow!(
                "{} holds no maze for a mouse: name a folder of such mazes, or a file",
                path.display()
            )));
        }
        looks.of_one(path, mazes.len() + half_known.len() + unsound.len())?;
        looks.check()?;
        Ok(Self {
            mazes,
            half_known,
            unsound,
        })
    }

    /// Returns the mazes without those that have unknown walls, which are told of as unfit.
    pub(in crate::cli) fn known(mut self) -> Self {
        for (file, _) in self.half_known.drain(..) {
            let name = input::name(&file);
            self.unsound.push(Failure::BadInput(anyhow!(
                "{name} has unknown walls: give it to `tolman race` or `tolman mouse`, which tell what is known"
            )));
        }
        self
    }

    /// Calls `tell` with each maze that has unknown walls, and returns whether there are no others.
    ///
    /// # Errors
    /// The first failure of `tell`.
    pub(in crate::cli) fn tell_half_known(
        &self,
        mut tell: impl FnMut(&Path, &MazeFile) -> Result,
    ) -> Result<bool> {
        for (path, file) in &self.half_known {
            tell(path, file)?;
        }
        Ok(self.mazes.is_empty() && !self.half_known.is_empty())
    }
}

/// Reads a valid maze whose start and goal the command line may give.
fn marked(file: &Path, marks: Option<&Marks>) -> Result<MazeFile> {
    let Some(marks) = marks.filter(|marks| !marks.are_none()) else {
        return input::read(file);
    };
    let mut read = input::parse(file)?;
    marks.put(&mut read)?;
    read.maze
        .check()
        .with_context(|| input::name(file))
        .or_bad_input()?;
    Ok(read)
}

/// Returns why a maze suits only robots, or `None` if it suits a mouse. A maze for mice has a
/// start, and cells of the width that the rules give.
fn for_robots(file: &MazeFile) -> Option<&'static str> {
    if file.corridor_width.is_some() {
        return Some("it says how wide its corridors are");
    }
    file.maze.start().is_none().then_some("it marks no start")
}

/// Calls `work` with each maze, `jobs` at a time or one per core, and `tell` with its results, in
/// the order of the mazes and as early as that allows. Shows progress.
///
/// # Errors
/// The first failure of `work` or `tell`, or if no threads can be started.
pub(in crate::cli) fn each<'a, T: Send>(
    mazes: &'a [(PathBuf, Maze)],
    jobs: Option<u16>,
    looks: &Looks,
    work: impl Fn(&'a Path, &'a Maze) -> Result<T> + Sync,
    mut tell: impl FnMut(T) -> Result,
) -> Result {
    // A single maze may be drawn on the terminal, so it runs on this thread.
    if let [(file, maze)] = mazes {
        let busy = busy(&input::name(file), looks.live);
        let done = work(file, maze);
        busy.finish_and_clear();
        return tell(done?);
    }
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs.map_or(0, usize::from))
        .build()
        .context("no threads can be started")?;
    let bar = ProgressBar::new(mazes.len() as u64);
    let (sender, results) = mpsc::channel();
    threads.in_place_scope(|scope| {
        scope.spawn(|_| {
            // Mazes take very different times, so each goes to the next core that is free. If
            // nobody receives the results any more, there was a failure.
            let mazes = mazes.iter().enumerate().par_bridge();
            let _ = mazes.try_for_each_with(sender, |sender, (number, (file, maze))| {
                sender.send((number, work(file, maze)))
            });
        });
        let (mut early, mut next) = (BTreeMap::new(), 0);
        for (number, done) in results {
            bar.inc(1);
            early.insert(number, done);
            while let Some(done) = early.remove(&next) {
                next += 1;
                bar.suspend(|| tell(done?))?;
            }
        }
        bar.finish_and_clear();
        Ok(())
    })
}

/// Failures of the mazes that cannot be used.
#[derive(Default)]
pub(in crate::cli) struct Unsound(Vec<Failure>);

impl Unsound {
    pub(in crate::cli) fn push(&mut self, failure: Failure) {
        self.0.push(failure);
    }

    /// Returns the number of failures.
    pub(in crate::cli) fn len(&self) -> usize {
        self.0.len()
    }

    /// Prints each failure, and fails if there are any. If the only maze failed, its own failure is
    /// returned.
    pub(in crate::cli) fn complain(&mut self, sound: usize) -> Result {
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
