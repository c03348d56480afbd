//! `tolman maze diff`: the walls in which two mazes differ.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use tolman_maze::{Knowledge, Walls};

use super::{Failure, Result, input};
use crate::cli::words::counted;

/// Tells the walls in which two mazes differ; exits 1 if there are any
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman maze diff mazes/grid/braided-1.txt mazes/grid/braided-1.txt")]
pub(crate) struct Arguments {
    /// Maze file; - reads standard input
    one: PathBuf,
    /// Maze file to compare it with
    other: PathBuf,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let (one, other) = (
        input::parse(&arguments.one)?,
        input::parse(&arguments.other)?,
    );
    let grid = one.maze.grid();
    if grid != other.maze.grid() {
        let size = |file: &tolman_maze::MazeFile| {
            format!(
                "{} × {}",
                file.maze.grid().width(),
                file.maze.grid().height()
            )
        };
        return Err(Failure::Failed(anyhow!(
            "the mazes have {} and {} cells",
            size(&one),
            size(&other)
        )));
    }
    let mut differ = 0;
    let mut line = |text: String| {
        differ += 1;
        writeln!(out, "{text}")
    };
    for (cell, side, _) in grid.inner_edges() {
        let (here, there) = (one.knowledge(cell, side), other.knowledge(cell, side));
        if here != there {
            line(format!("{cell} {side}: {}, {}", word(here), word(there)))?;
        }
    }
    if one.maze.start() != other.maze.start() {
        line("the starts differ".to_owned())?;
    }
    if one.maze.goals() != other.maze.goals() {
        line("the goals differ".to_owned())?;
    }
    match differ {
        0 => Ok(writeln!(out, "the mazes are the same")?),
        _ => Err(Failure::Failed(anyhow!(
            "the mazes differ in {}",
            counted(differ, "line")
        ))),
    }
}

const fn word(knowledge: Knowledge) -> &'static str {
    match knowledge {
        Knowledge::Wall => "wall",
        Knowledge::Open => "open",
        Knowledge::Unknown => "unknown",
    }
}
