//! Mice that are sent through one maze or many, shown on their way, and told of.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Error, anyhow};
use clap::ArgGroup;
use serde_json::{Value, json};
use tolman_maze::Maze;

use super::looks::Looks;
use super::maze::Collection;
use super::mouse::Way;
use super::{Failure, Result, maze};

/// Maze file or folder that robots are sent through, as MAZE or as --maze.
#[derive(clap::Args)]
pub(super) struct MazePath {
    /// Maze file of any format, or a folder of them
    #[arg(value_name = "MAZE|DIR")]
    maze: Option<PathBuf>,
    /// The same as MAZE
    #[arg(long = "maze", value_name = "FILE|DIR")]
    maze_file: Option<PathBuf>,
}

impl MazePath {
    /// Returns the path, if one was given.
    pub(super) fn path(&self) -> Option<&Path> {
        self.maze.as_deref().or(self.maze_file.as_deref())
    }
}

/// Returns the group that requires a maze.
pub(super) fn required() -> ArgGroup {
    ArgGroup::new("one")
        .args(["maze", "maze_file"])
        .required(true)
}

/// Returns the group that requires a maze or the flag `other`, and no two of them.
pub(super) fn maze_or(other: &'static str) -> ArgGroup {
    let one = ArgGroup::new("one").args(["maze", "maze_file", other]);
    one.required(true)
}

/// Outcome for a mouse whose start is a goal.
pub(super) const ON_GOAL: &str = "the start is a goal, so the best run has no length";

/// Result of a mouse in a maze.
pub(super) trait MouseResult: Send {
    /// Returns the outcome in words.
    fn outcome(&self) -> String;

    /// Returns the figures of each line of `--json`, which names the maze besides.
    fn json(&self) -> Result<Vec<Value>, Error>;

    /// Returns whether the mouse solved its maze.
    fn has_solved(&self) -> bool;

    /// Returns the results of several mazes in one line.
    fn summary(all: &[(&Path, Self)]) -> String
    where
        Self: Sized;
}

/// Calls `send` with each maze, `jobs` at a time or one per core, and tells the results. `draw`
/// writes what comes before their summary.
///
/// # Errors
/// If a maze is invalid, a mouse did not solve its maze, or a file cannot be written.
pub(super) fn send_all<'a, T: MouseResult>(
    Collection { mazes, unsound, .. }: &'a mut Collection,
    jobs: Option<u16>,
    looks: &Looks,
    out: &mut dyn Write,
    send: impl Fn(&'a Path, &'a Maze) -> Result<(T, Option<Way>)> + Sync,
    draw: impl FnOnce(&[(&Path, T)], &mut dyn Write) -> Result,
) -> Result {
    // A maze that no mouse can run in must not stop the others.
    let work = |file, maze| Ok(send(file, maze).map(|(tried, way)| (file, tried, way)));
    let mut told = Vec::new();
    maze::each(mazes, jobs, looks, work, |sent| {
        match sent {
            Ok((file, tried, way)) => {
                tell(file, &tried, way, looks, out)?;
                told.push((file, tried));
            }
            Err(failure) => unsound.push(failure),
        }
        Ok(())
    })?;
    summarize(&told, looks, out, draw)?;
    unsound.complain(told.len())?;
    all_solved(&told)
}

/// Tells the result in a maze at once, so that it stays if the others are interrupted. Shows the
/// mouse's way, if there is one.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn tell(
    file: &Path,
    tried: &impl MouseResult,
    way: Option<Way>,
    looks: &Looks,
    out: &mut dyn Write,
) -> Result {
    let (name, outcome) = (maze::name(file), tried.outcome());
    if let Some(way) = way {
        way.show(looks, &outcome)?;
    }
    if looks.json {
        for mut line in tried.json()? {
            line["maze"] = json!(name);
            writeln!(out, "{line}")?;
        }
    } else {
        writeln!(out, "{name}: {outcome}")?;
    }
    Ok(out.flush()?)
}

/// Tells of all results together.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn summarize<T: MouseResult>(
    told: &[(&Path, T)],
    looks: &Looks,
    out: &mut dyn Write,
    draw: impl FnOnce(&[(&Path, T)], &mut dyn Write) -> Result,
) -> Result {
    if !looks.json {
        draw(told, out)?;
        if told.len() > 1 {
            writeln!(out, "{}", T::summary(told))?;
        }
        looks.tell_replay(out)?;
    }
    // Results come before complaints, even if both streams go to one place.
    Ok(out.flush()?)
}

/// Fails if the mouse did not solve all mazes. The failure names a single unsolved maze.
///
/// # Errors
/// A failure with the number of mazes that were not solved.
pub(super) fn all_solved<T: MouseResult>(tried: &[(&Path, T)]) -> Result {
    let mut unsolved = tried.iter().filter(|(_, tried)| !tried.has_solved());
    let which = match (unsolved.clone().count(), unsolved.next()) {
        (_, None) => return Ok(()),
        (_, Some((only, _))) if tried.len() == 1 => maze::name(only),
        (count, _) => format!("{count} of {} mazes", tried.len()),
    };
    Err(Failure::Failed(anyhow!("the mouse did not solve {which}")))
}
