//! `tolman maze show`: draws a maze.

use std::io::Write;
use std::path::PathBuf;

use tolman_maze::{Direction, Format, MazeFile, write};

use super::{Result, input, summary::Summary};

/// Draws a maze of any format as text
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman maze show mazes/j.maze")]
pub(crate) struct Arguments {
    /// Maze file; - reads standard input
    file: PathBuf,
    /// Write the figures and the drawing as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let read = input::parse(&arguments.file)?;
    let summary = Summary::of(input::name(&arguments.file), &read);
    if arguments.json {
        let mut json = serde_json::to_value(&summary)?;
        json["drawing"] = drawing(&read).into();
        return Ok(writeln!(out, "{json:#}")?);
    }
    if let Some(name) = &read.name {
        writeln!(out, "{name}")?;
    }
    Ok(writeln!(out, "{}{summary}", drawing(&read))?)
}

/// Returns the drawing of a maze, with a `.` for each unknown wall.
fn drawing(read: &MazeFile) -> String {
    let mut file = read.clone();
    // The drawing has no headings.
    let start = file.maze.start().map(|(cell, _)| (cell, Direction::North));
    file.maze.set_start(start);
    write(&file, Format::Mazefiles).unwrap_or_else(|_| read.maze.to_string())
}
