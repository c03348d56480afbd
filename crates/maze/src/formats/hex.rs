//! [`Format::Hex`](super::Format::Hex): a hexadecimal digit for the walls of each cell.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::lines::{Line, Lines};
use super::sides::{self, Sides};
use super::{Format, MazeError, MazeFault, Parsed, WriteError, expect_classic};
use crate::{Cell, Direction, Grid, Maze};

/// Returns whether rows of digits begin with this text. A number above lines with commas is a size.
pub(super) fn begins(mut lines: Lines<'_>) -> bool {
    let mut row = || lines.next_filled().map(|line| line.text.trim());
    let is_row = |text: &str| text.len() >= 2 && text.chars().all(|c| c.is_ascii_hexdigit());
    row().is_some_and(is_row) && row().is_some_and(is_row)
}

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    lines.skip_blank();
    let rows: Vec<Line<'_>> = lines.by_ref().take_while(|line| !line.is_blank()).collect();
    let Some(first) = rows.first().copied() else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    let width = first.text.trim().len();
    let side = |side: usize| {
        let small = u16::try_from(side)
            .ok()
            .filter(|side| *side <= Grid::MAX_SIDE);
        small.ok_or_else(|| first.fault(0, MazeFault::TooLarge { side }))
    };
    let grid = Grid::new(side(width)?, side(rows.len())?);
    let mut cells = Vec::with_capacity(grid.cell_count());
    // Southern rows first.
    for line in rows.iter().rev() {
        let digits = line.text.trim();
        if digits.chars().count() != width {
            let found = digits.chars().count();
            return Err(line.fault(0, MazeFault::Ragged { found, width }));
        }
        let mut place = line.place_of(digits);
        for digit in digits.chars() {
            let Some(walls) = digit.to_digit(16) else {
                let expected =
                    "a hexadecimal digit, the sum of walls: 1 north, 2 east, 4 south, 8 west";
                return Err(place.fault(MazeFault::Character {
                    found: digit,
                    expected,
                }));
            };
            let open = (!walls & 0xf) as u8;
            cells.push(Sides { open, place });
            place = place.right(1);
        }
    }
    let mut parsed = sides::parsed(grid, &cells)?;
    // Entry and exit, as column and row from the north-west.
    let mut mark = || -> Result<Option<Cell>, MazeError> {
        let Some(line) = lines.next_filled() else {
            return Ok(None);
        };
        let text = line.text.trim();
        let number = |text: &str| text.trim().parse::<u16>().ok();
        let cell = text.split_once([',', ' ']).and_then(|(x, row)| {
            let y = grid.height().checked_sub(1 + number(row)?)?;
            Some(Cell::new(number(x)?, y)).filter(|cell| grid.contains(*cell))
        });
        let expected =
            "the column and row of a cell, counted from 0 in the north-west, as in `0,15`";
        cell.map(Some)
            .ok_or_else(|| line.place_of(text).fault(MazeFault::number(text, expected)))
    };
    let maze = &mut parsed.file.maze;
    if let Some(start) = mark()? {
        maze.set_start(Some((start, Direction::North)));
    }
    if let Some(goal) = mark()? {
        maze.set_goals(alloc::vec![goal]);
    }
    Ok(parsed)
}

/// Returns the maze, with its start and goal if there is one goal.
pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    let grid = maze.grid();
    let marks = match (maze.start(), maze.goals()) {
        (Some((start, Direction::North)), [goal]) => Some([start, *goal]),
        _ => {
            expect_classic(maze, Format::Hex)?;
            None
        }
    };
    let mut text = String::new();
    for y in (0..grid.height()).rev() {
        for x in 0..grid.width() {
            let walls = !sides::open_sides(maze, Cell::new(x, y)) & 0xf;
            text.push_str(&format!("{walls:X}"));
        }
        text.push('\n');
    }
    if let Some(marks) = marks {
        for cell in marks {
            text.push_str(&format!("\n{},{}", cell.x, grid.height() - 1 - cell.y));
        }
        text.push('\n');
    }
    Ok(text)
}
