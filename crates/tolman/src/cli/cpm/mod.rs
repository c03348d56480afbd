//! `tolman cpm`: the e-puck that learns common-pattern maps.

mod learn;
mod solve;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, anyhow};
use clap::Subcommand;
use tolman::agents::cpm::MapFile;
use tolman_maze::Maze;
use tolman_sim::{CorridorSize, World, WorldError};

use super::failure::OrBadInput;
use super::{Failure, maze};

/// An e-puck that learns a common-pattern map of a maze, and drives by it
#[derive(Subcommand)]
pub(super) enum Verb {
    Learn(learn::Arguments),
    Solve(solve::Arguments),
}

impl Verb {
    pub(super) fn carry_out(self, out: &mut dyn Write) -> Result<(), Failure> {
        match self {
            Self::Learn(arguments) => learn::carry_out(&arguments, out),
            Self::Solve(arguments) => solve::carry_out(&arguments, out),
        }
    }
}

/// From wall to wall where a maze file does not say, m.
const CORRIDOR_WIDTH: f64 = 0.25;

/// A maze that an e-puck can run in.
pub(super) struct Course {
    pub(super) name: String,
    pub(super) maze: Maze,
    pub(super) corridor_width: f64,
}

impl Course {
    /// Its walls.
    pub(super) fn world(&self) -> Result<World, WorldError> {
        let size = CorridorSize {
            corridor_width: self.corridor_width,
            wall_thickness: 0.0,
        };
        World::from_maze(&self.maze, &size)
    }
}

/// Reads a maze file with a start.
///
/// # Errors
/// Bad input.
pub(super) fn course(path: &Path) -> Result<Course, Failure> {
    let file = maze::read(path)?;
    if file.maze.start().is_none() {
        let name = maze::name(path);
        return Err(Failure::BadInput(anyhow!(
            "{name}: the maze marks no start: mark a cell with S"
        )));
    }
    Ok(Course {
        name: file.name.unwrap_or_else(|| maze::name(path)),
        maze: file.maze,
        corridor_width: file.corridor_width.unwrap_or(CORRIDOR_WIDTH),
    })
}

/// Reads a map that `tolman cpm learn` wrote.
///
/// # Errors
/// Bad input with the file's name.
pub(super) fn parse(path: &Path, text: &str) -> Result<MapFile, Failure> {
    MapFile::from_json(text)
        .with_context(|| path.display().to_string())
        .or_bad_input()
}
