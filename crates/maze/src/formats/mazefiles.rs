//! [`Format::Mazefiles`](super::Format::Mazefiles): a drawing alone.

use alloc::string::{String, ToString};

use super::lines::Lines;
use super::{CLASSIC_START, Format, MazeError, Parsed, WriteError, drawing};
use crate::{Direction, Maze};

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    lines.skip_blank();
    let mut parsed = drawing::parse(lines)?;
    if parsed.file.maze.start().is_none() {
        parsed.file.maze.set_start(Some(CLASSIC_START));
    }
    Ok(parsed)
}

pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    match maze.start() {
        Some((_, Direction::North)) => Ok(maze.to_string()),
        start => Err(WriteError::Start {
            format: Format::Mazefiles,
            start,
        }),
    }
}
