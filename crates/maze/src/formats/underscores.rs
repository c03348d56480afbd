//! [`Format::Underscores`](super::Format::Underscores): drawings of `_` and `|`, two characters a
//! cell.

use alloc::string::String;
use alloc::vec::Vec;

use super::lines::{Line, Lines};
use super::{CLASSIC_START, Format, MazeError, MazeFault, Parsed, WriteError, expect_classic};
use crate::{Cell, Direction, Grid, Maze};

/// Returns whether a drawing begins with this line, the northern border.
pub(super) fn begins(line: &str) -> bool {
    line.starts_with('_') && line.chars().all(|c| matches!(c, '_' | ' '))
}

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    lines.skip_blank();
    let Some(border) = lines.next() else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    let rows: Vec<Line<'_>> = lines.take_while(|line| !line.is_blank()).collect();
    let side = |side: usize| {
        let small = u16::try_from(side).ok();
        let small = small.filter(|side| (1..=Grid::MAX_SIDE).contains(side));
        small.ok_or_else(|| border.fault(0, MazeFault::TooLarge { side }))
    };
    // A blank or a wall, then a floor and a wall for each cell.
    let grid = Grid::new(
        side(border.text.trim_end().chars().count() / 2)?,
        side(rows.len())?,
    );
    let mut maze = Maze::open(grid);
    let (mut start, mut goals) = (None, Vec::new());
    for (line, y) in rows.iter().zip((0..grid.height()).rev()) {
        let mut chars = line.text.chars();
        if chars.next() != Some('|') {
            let expected = "`|` at the west border";
            let found = line.text.chars().next().unwrap_or('\n');
            return Err(line.fault(0, MazeFault::Character { found, expected }));
        }
        for x in 0..grid.width() {
            let cell = Cell::new(x, y);
            let mut next = |expected, allowed: fn(char) -> bool| {
                let found = chars.next().unwrap_or(' ');
                let offset = line.text.len() - chars.as_str().len();
                match allowed(found) {
                    true => Ok(found),
                    false => Err(line.fault(
                        offset.saturating_sub(1),
                        MazeFault::Character { found, expected },
                    )),
                }
            };
            let floor = next("`_`, a blank, `S` or `G` for a cell", |c| {
                "_ SGsg".contains(c)
            })?;
            let wall = next("`|`, `_` or a blank between two cells", |c| {
                "|_ ".contains(c)
            })?;
            match floor {
                'S' | 's' => start = Some((cell, Direction::North)),
                'G' | 'g' => goals.push(cell),
                _ => {}
            }
            // The border is closed, drawn or not.
            if y > 0 {
                maze.set_wall(cell, Direction::South, floor == '_');
            }
            if x + 1 < grid.width() {
                maze.set_wall(cell, Direction::East, wall == '|');
            }
        }
    }
    maze.set_start(start.or(Some(CLASSIC_START)));
    if goals.is_empty() {
        goals = grid.middle().collect();
    }
    maze.set_goals(goals);
    Ok(Parsed {
        begin: border.place(0),
        ..Parsed::new(maze, Vec::new())
    })
}

/// Returns the maze without marks: there is no room for them above a wall.
pub(super) fn write(maze: &Maze) -> Result<String, WriteError> {
    expect_classic(maze, Format::Underscores)?;
    let grid = maze.grid();
    let mut text = String::new();
    for _ in 0..grid.width() {
        text.push_str(" _");
    }
    text.push('\n');
    for y in (0..grid.height()).rev() {
        text.push('|');
        for x in 0..grid.width() {
            let open = |side| maze.is_open(Cell::new(x, y), side);
            text.push(if open(Direction::South) { ' ' } else { '_' });
            text.push(if open(Direction::East) { ' ' } else { '|' });
        }
        text.push('\n');
    }
    Ok(text)
}
