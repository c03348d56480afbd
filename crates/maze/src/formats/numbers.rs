//! [`Format::Numbers`](super::Format::Numbers): the micromouse paper's test program.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::lines::{Line, Lines};
use super::sides::{self, Sides};
use super::{Format, MazeError, MazeFault, Parsed, WriteError, expect_classic};
use crate::{Cell, Grid, Maze};

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    let grid = size(lines)?;
    let side = usize::from(grid.width());

    // Line x holds column x: the cells come column by column, and are wanted row by row.
    let mut columns: Vec<Sides> = Vec::new();
    for x in 0..side {
        let Some(line) = lines.next().filter(|line| !line.is_blank()) else {
            let fault = MazeFault::Count {
                found: x,
                expected: side,
                what: "columns",
                repair: "write one line for each column of the maze, from the west",
            };
            let place = Line {
                number: lines.read(),
                text: "",
            }
            .place(0);
            return Err(place.fault(fault));
        };
        let count = line.text.split(',').count();
        if count != side {
            let fault = MazeFault::Count {
                found: count,
                expected: side,
                what: "numbers",
                repair: "write one number for each row of the maze, from the south, with commas \
                         between them",
            };
            return Err(line.fault(0, fault));
        }
        // Places are counted along, not looked up: a line may be long.
        let mut place = line.place(0);
        for item in line.text.split(',') {
            let number = item.trim();
            let blanks = item.chars().take_while(|c| c.is_whitespace()).count();
            let here = place.right(blanks.min(item.chars().count().saturating_sub(1)));
            let open = number.parse::<u8>().ok().filter(|open| *open < 16);
            let Some(open) = open else {
                return Err(here.fault(MazeFault::number(
                    number,
                    "a sum of open sides, 0 … 15: 1 north, 2 east, 4 south, 8 west",
                )));
            };
            columns.push(Sides { open, place: here });
            place = place.right(item.chars().count() + 1);
        }
    }
    if let Some(line) = lines.next_filled() {
        let fault = MazeFault::Count {
            found: side + 1,
            expected: side,
            what: "columns",
            repair: "drop this line, or correct the size on line 1",
        };
        return Err(line.fault(0, fault));
    }

    let index = |cell: Cell| usize::from(cell.x) * side + usize::from(cell.y);
    let cell_at = |cell| columns.get(index(cell)).copied();
    let rows: Vec<Sides> = grid.cells().filter_map(cell_at).collect();
    sides::parsed(grid, &rows)
}

fn size(lines: &mut Lines<'_>) -> Result<Grid, MazeError> {
    const EXPECTED: &str = "the size of the maze, an even number of cells";
    let Some(line) = lines.next_filled() else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    let text = line.text.trim();
    let place = line.place_of(text);
    let side = text
        .parse::<u32>()
        .map_err(|_| place.fault(MazeFault::number(text, EXPECTED)))?;
    match u16::try_from(side) {
        Ok(side) if side <= Grid::MAX_SIDE => {
            if side == 0 || !side.is_multiple_of(2) {
                return Err(place.fault(MazeFault::number(text, EXPECTED)));
            }
            Ok(Grid::new(side, side))
        }
        _ => Err(place.fault(MazeFault::TooLarge {
            side: side as usize,
        })),
    }
}

pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    let grid = maze.grid();
    let format = Format::Numbers;
    if grid.width() != grid.height() || !grid.width().is_multiple_of(2) {
        return Err(WriteError::Shape { format, grid });
    }
    expect_classic(maze, format)?;
    let mut text = grid.width().to_string();
    for x in 0..grid.width() {
        for y in 0..grid.height() {
            text.push(if y == 0 { '\n' } else { ',' });
            text.push_str(&sides::open_sides(maze, Cell::new(x, y)).to_string());
        }
    }
    text.push('\n');
    Ok(text)
}
