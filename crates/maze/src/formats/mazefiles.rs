//! [`Format::Mazefiles`](super::Format::Mazefiles): a drawing alone, of whatever characters.

use alloc::string::String;

use super::lines::Lines;
use super::{CLASSIC_START, Format, MazeError, MazeFile, Parsed, WriteError, drawing};
use crate::Direction;

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    lines.skip_blank();
    let mut parsed = drawing::parse(lines)?;
    if parsed.file.maze.start().is_none() {
        parsed.file.maze.set_start(Some(CLASSIC_START));
    }
    Ok(parsed.or_middle())
}

pub(super) fn write(file: &MazeFile, format: Format) -> Result<String, WriteError> {
    match file.maze.start() {
        Some((_, Direction::North)) => Ok(drawing::text(file)),
        start => Err(WriteError::Start { format, start }),
    }
}
