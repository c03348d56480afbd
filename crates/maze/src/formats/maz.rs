//! [`Format::Maz`](super::Format::Maz): a byte for the walls of each cell.

use alloc::string::String;
use alloc::vec::Vec;

use super::lines::Place;
use super::sides::{self, Sides};
use super::{Format, MazeError, Parsed, WriteError, expect_classic};
use crate::{Cell, Grid, Maze};

/// Returns the side of a maze of this number of bytes, cells.
const fn side(bytes: usize) -> Option<u16> {
    match bytes {
        256 => Some(16),
        1024 => Some(32),
        _ => None,
    }
}

/// Returns the text of a file of bytes, if it is a maze: its upper bits are marks of the mouse that
/// wrote it, and are dropped.
#[must_use]
pub fn maz_text(bytes: &[u8]) -> Option<String> {
    side(bytes.len())?;
    // A text holds few control characters.
    let controls = bytes
        .iter()
        .filter(|byte| !matches!(byte, 0x20..=0x7e))
        .count();
    (2 * controls > bytes.len()).then(|| bytes.iter().map(|byte| char::from(byte & 0xf)).collect())
}

pub(super) fn begins(text: &str) -> bool {
    side(text.len()).is_some() && text.bytes().all(|byte| byte < 0x10)
}

pub(super) fn parse(text: &str) -> Result<Parsed, MazeError> {
    let side = side(text.len()).unwrap_or(16);
    let grid = Grid::new(side, side);
    // Column by column, from the south-west.
    let cells = grid.cells().map(|cell| {
        let number = usize::from(cell.x) * usize::from(side) + usize::from(cell.y);
        let walls = text.as_bytes().get(number).copied().unwrap_or(0xf);
        let place = Place::default().right(number);
        Sides {
            open: !walls & 0xf,
            place,
        }
    });
    sides::parsed(grid, &cells.collect::<Vec<_>>())
}

pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    let (format, grid) = (Format::Maz, maze.grid());
    if grid.width() != grid.height() || !matches!(grid.width(), 16 | 32) {
        return Err(WriteError::Shape { format, grid });
    }
    expect_classic(maze, format)?;
    let columns = (0..grid.width()).flat_map(|x| (0..grid.height()).map(move |y| Cell::new(x, y)));
    let walls = columns.map(|cell| char::from(!sides::open_sides(maze, cell) & 0xf));
    Ok(walls.collect())
}
