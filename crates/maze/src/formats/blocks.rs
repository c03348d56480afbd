//! [`Format::Blocks`](super::Format::Blocks): grids of walls and floors, one or two characters
//! each.

use alloc::string::String;
use alloc::vec::Vec;

use super::lines::{Line, Lines};
use super::{CLASSIC_START, Format, MazeError, MazeFault, Parsed, WriteError};
use crate::{Cell, CheckError, Direction, Grid, Maze};

/// Returns whether a grid begins with these lines: one all of wall above one of walls and floors,
/// or the head of a map of moving-AI. A line of `#` alone is a comment.
pub(super) fn begins(mut lines: Lines<'_>) -> bool {
    let mut row = || lines.next_filled().map_or("", |line| line.text.trim_end());
    let (first, second) = (row(), row());
    let is_solid = match first.chars().next() {
        Some('1') => first.len() >= 5 && first.chars().all(|c| c == '1'),
        _ => first.len() >= 3 && first.chars().all(|c| matches!(c, '#' | '@')),
    };
    let is_row = second.len() >= 3 && second.chars().all(|c| is_wall(c) || is_floor(c));
    first.starts_with("type ") || (is_solid && is_row && second.starts_with(is_wall))
}

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    lines.skip_blank();
    let mut ahead = lines.clone();
    if ahead
        .next()
        .is_some_and(|line| line.text.starts_with("type "))
    {
        // The head of a moving-AI map ends with a line `map`.
        let _ = lines.find(|line| line.text.trim() == "map");
    }
    let mut rows: Vec<(Line<'_>, Vec<char>)> = lines
        .take_while(|line| !line.is_blank())
        .map(|line| (line, line.text.trim_end().chars().collect()))
        .collect();
    let Some((first, width)) = rows.first().map(|(line, row)| (*line, row.len())) else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    for (line, row) in &mut rows {
        if row.len() > width {
            return Err(line.fault(
                0,
                MazeFault::Ragged {
                    found: row.len(),
                    width,
                },
            ));
        }
        row.resize(width, ' ');
        if let Some(at) = row.iter().position(|c| !is_wall(*c) && !is_floor(*c)) {
            let found = row.get(at).copied().unwrap_or('\n');
            let expected =
                "`#`, `@` or `1` for a wall, a blank, `.` or `0` for a floor, or `S`, `G` or `E`";
            return Err(line
                .place(0)
                .right(at)
                .fault(MazeFault::Character { found, expected }));
        }
    }
    let blocks = halved(&rows).unwrap_or_else(|| rows.iter().map(|(_, row)| row.clone()).collect());
    lattice(first, &blocks)
}

/// Returns the blocks of a grid that is drawn two characters wide, or `None` if it is not.
fn halved(rows: &[(Line<'_>, Vec<char>)]) -> Option<Vec<Vec<char>>> {
    let block = |pair: &[char]| match pair {
        [one, other] if one == other || (is_wall(*one) && is_wall(*other)) => Some(*one),
        [' ', mark] | [mark, ' '] if !is_wall(*mark) => Some(*mark),
        _ => None,
    };
    let is_lattice = |blocks: &Vec<Vec<char>>| {
        blocks.len() % 2 == 1 && blocks.first().is_some_and(|row| row.len() % 2 == 1)
    };
    let rows = rows
        .iter()
        .map(|(_, row)| row.chunks(2).map(block).collect());
    rows.collect::<Option<Vec<Vec<char>>>>().filter(is_lattice)
}

/// Returns the maze of blocks whose walls are on every second row and column.
fn lattice(first: Line<'_>, blocks: &[Vec<char>]) -> Result<Parsed, MazeError> {
    let (columns, rows) = (blocks.first().map_or(0, Vec::len), blocks.len());
    if columns % 2 == 0 || rows % 2 == 0 || columns < 3 || rows < 3 {
        return Err(first.fault(0, MazeFault::NoLattice { columns, rows }));
    }
    let side = |blocks: usize| {
        let side = blocks / 2;
        let small = u16::try_from(side)
            .ok()
            .filter(|side| *side <= Grid::MAX_SIDE);
        small.ok_or_else(|| first.fault(0, MazeFault::TooLarge { side }))
    };
    let grid = Grid::new(side(columns)?, side(rows)?);
    let at = |column: usize, row: usize| {
        let row = blocks.get(row).and_then(|row| row.get(column));
        row.copied().unwrap_or('#')
    };
    let mut maze = Maze::open(grid);
    let (mut start, mut goals) = (None, Vec::new());
    for cell in grid.cells() {
        let (column, row) = (
            2 * usize::from(cell.x) + 1,
            rows - 2 - 2 * usize::from(cell.y),
        );
        match at(column, row) {
            'S' | 's' => start = Some((cell, Direction::North)),
            'G' | 'g' | 'E' | 'e' => goals.push(cell),
            c if is_wall(c) => {
                let place = Line {
                    number: first.number + row,
                    ..first
                }
                .place(0)
                .right(column);
                return Err(place.fault(MazeFault::NoLattice { columns, rows }));
            }
            _ => {}
        }
        for (side, (east, south)) in
            Direction::ALL
                .into_iter()
                .zip([(0, -1), (1, 0), (0, 1), (-1, 0)])
        {
            let beside = |at: usize, step: isize| at.saturating_add_signed(step);
            let stands = is_wall(at(beside(column, east), beside(row, south)));
            if !stands && grid.neighbour(cell, side).is_none() {
                let fault = MazeFault::Maze(CheckError::OpenBorder {
                    cell,
                    direction: side,
                });
                let line = Line {
                    number: first.number + row,
                    ..first
                };
                return Err(line.place(0).right(column).fault(fault));
            }
            maze.set_wall(cell, side, stands);
        }
    }
    maze.set_start(start.or(Some(CLASSIC_START)));
    maze.set_goals(goals);
    Ok(Parsed {
        begin: first.place(0),
        ..Parsed::new(maze, Vec::new())
    }
    .or_middle())
}

const fn is_wall(c: char) -> bool {
    matches!(c, '#' | '@' | '1' | 'T' | 'O' | 'W')
}

const fn is_floor(c: char) -> bool {
    matches!(c, ' ' | '.' | '0' | 'S' | 's' | 'G' | 'g' | 'E' | 'e')
}

/// Returns the maze as `#` and blanks, one character a block, with `S` and `G`.
pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    let grid = maze.grid();
    match maze.start() {
        Some((start, Direction::North)) if !maze.goals().contains(&start) => {}
        start => {
            let format = Format::Blocks;
            return Err(WriteError::Start { format, start });
        }
    }
    let mut text = String::new();
    let wall = |open: bool| if open { ' ' } else { '#' };
    for y in (0..grid.height()).rev() {
        for x in 0..grid.width() {
            text.push('#');
            text.push(wall(maze.is_open(Cell::new(x, y), Direction::North)));
        }
        text.push_str("#\n#");
        for x in 0..grid.width() {
            let cell = Cell::new(x, y);
            text.push(match maze.start() {
                Some((start, _)) if start == cell => 'S',
                _ if maze.goals().contains(&cell) => 'G',
                _ => ' ',
            });
            text.push(wall(maze.is_open(cell, Direction::East)));
        }
        text.push('\n');
    }
    text.extend(core::iter::repeat_n('#', 2 * usize::from(grid.width()) + 1));
    text.push('\n');
    Ok(text)
}
