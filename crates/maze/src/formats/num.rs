//! [`Format::Num`](super::Format::Num): the simulator mms.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::lines::{Line, Lines};
use super::sides::{self, Sides};
use super::{Format, MazeError, MazeFault, Parsed, WriteError, expect_classic};
use crate::{Cell, Direction, Grid, Maze};

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    let mut cells = Vec::new();
    while let Some(line) = lines.next_filled() {
        cells.push(cell(line)?);
    }
    let side = |coordinate: fn(&(Cell, Sides)) -> u16| cells.iter().map(coordinate).max();
    let (Some(x), Some(y)) = (side(|(cell, _)| cell.x), side(|(cell, _)| cell.y)) else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    let grid = Grid::new(x + 1, y + 1);

    // Sorted, every cell must follow the one before. Nothing of the grid's size is allocated before
    // that is known: a single line can ask for a large maze.
    cells.sort_by_key(|(cell, sides)| (grid.index(*cell), sides.place.line()));
    let end = cells
        .last()
        .map(|(_, sides)| sides.place)
        .unwrap_or_default();
    for pair in cells.windows(2) {
        if let [(cell, first), (next, second)] = pair
            && cell == next
        {
            let fault = MazeFault::Duplicate {
                cell: *cell,
                first_line: first.place.line(),
            };
            return Err(second.place.fault(fault));
        }
    }
    let listed = cells
        .iter()
        .map(|(cell, _)| Some(*cell))
        .chain(core::iter::repeat(None));
    if let Some((cell, _)) = grid
        .cells()
        .zip(listed)
        .find(|(cell, listed)| *listed != Some(*cell))
    {
        return Err(end.fault(MazeFault::Missing { cell, grid }));
    }

    let sides: Vec<Sides> = cells.into_iter().map(|(_, sides)| sides).collect();
    sides::parsed(grid, &sides)
}

/// Reads a line `X Y N E S W`.
fn cell(line: Line<'_>) -> Result<(Cell, Sides), MazeError> {
    let mut words = [""; 6];
    let mut found = 0;
    for word in line.text.split_whitespace() {
        if let Some(slot) = words.get_mut(found) {
            *slot = word;
        }
        found += 1;
    }
    if found != words.len() {
        let fault = MazeFault::Count {
            found,
            expected: words.len(),
            what: "numbers",
            repair: "a line has the column, the row, and 1 or 0 for the walls in the north, east, \
                     south and west",
        };
        return Err(line.fault(0, fault));
    }
    let [x, y, walls @ ..] = words;
    let coordinate = |word| -> Result<u16, MazeError> {
        let place = line.place_of(word);
        let fault = |_| place.fault(MazeFault::number(word, "a column or row counted from 0"));
        let number = word.parse::<u32>().map_err(fault)?;
        match u16::try_from(number) {
            Ok(number) if number < Grid::MAX_SIDE => Ok(number),
            _ => Err(place.fault(MazeFault::TooLarge {
                side: number as usize + 1,
            })),
        }
    };
    let cell = Cell::new(coordinate(x)?, coordinate(y)?);
    let mut open = 0;
    for (direction, word) in Direction::ALL.into_iter().zip(walls) {
        match word {
            "0" => open |= 1 << direction.index(),
            "1" => {}
            _ => {
                let fault = MazeFault::number(word, "1 for a wall or 0 for none");
                return Err(line.place_of(word).fault(fault));
            }
        }
    }
    Ok((
        cell,
        Sides {
            open,
            place: line.place(0),
        },
    ))
}

pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    expect_classic(maze, Format::Num)?;
    let grid = maze.grid();
    let mut text = String::new();
    // Column by column, as mms does it.
    for x in 0..grid.width() {
        for y in 0..grid.height() {
            let walls = Direction::ALL.map(|side| u8::from(!maze.is_open(Cell::new(x, y), side)));
            let [north, east, south, west] = walls;
            text.push_str(&format!("{x} {y} {north} {east} {south} {west}\n"));
        }
    }
    Ok(text)
}
