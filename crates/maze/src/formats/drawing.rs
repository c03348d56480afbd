//! The drawing of posts and walls that the `mazefiles` collection, mms and tolman's own files share.

use alloc::vec::Vec;
use core::fmt;

use super::lines::{Line, Lines, Place};
use super::{Fault, MazeError, Parsed};
use crate::{Cell, Direction, Grid, Maze};

/// Characters from one post to the next.
const PITCH: usize = 4;

/// Whether `c` may stand where lines of a drawing have their posts.
pub(super) const fn is_post(c: char) -> bool {
    matches!(c, 'o' | '+')
}

/// Reads a drawing from its first line on, which `lines` must be about to give.
///
/// The drawing ends before the first line that starts with neither a post, a wall nor a blank; that
/// line is the next of `lines`. The start is where the `S` is, looking north.
pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    let rows = rows(lines)?;
    let Some((first, _)) = rows.split_first() else {
        return Err(MazeError::at_start(Fault::Empty));
    };
    let width = width(first);
    let height = rows.len() / 2;
    for side in [width, height] {
        if side > usize::from(Grid::MAX_SIDE) {
            return Err(first.line.fault(0, Fault::TooLarge { side }));
        }
    }
    if rows.len() < 3 || rows.len().is_multiple_of(2) {
        let last = rows.last().unwrap_or(first);
        return Err(last.line.fault(0, Fault::Unfinished { lines: rows.len() }));
    }

    // Both sides were held to MAX_SIDE above.
    let grid = Grid::new(width as u16, height as u16);
    let mut maze = Maze::open(grid);
    let mut places = alloc::vec![Place::default(); grid.cell_count()];
    let mut start = None;
    let mut goals = Vec::new();

    // Walls are read from the line or column to the north and west of a cell; the south and east
    // borders, which no such cell has, come last.
    for (index, row) in rows.iter().enumerate() {
        let beyond = height as u16 - (index / 2) as u16;
        if index.is_multiple_of(2) {
            for x in 0..grid.width() {
                row.post(usize::from(x))?;
                let stands = row.horizontal(usize::from(x))?;
                let (cell, side) = match beyond.checked_sub(1) {
                    Some(y) => (Cell::new(x, y), Direction::North),
                    None => (Cell::new(x, 0), Direction::South),
                };
                maze.set_wall(cell, side, stands);
                row.border(&maze, cell, side, usize::from(x) * PITCH + 2)?;
            }
            row.post(width)?;
        } else {
            let y = beyond - 1;
            for x in 0..grid.width() {
                let (cell, at) = (Cell::new(x, y), usize::from(x) * PITCH);
                maze.set_wall(cell, Direction::West, row.vertical(usize::from(x))?);
                row.border(&maze, cell, Direction::West, at)?;
                places[grid.index(cell)] = row.place(at + 2);
                for offset in at + 1..at + PITCH {
                    match row.char(offset) {
                        ' ' => {}
                        'S' | 's' => match start.replace(cell) {
                            Some(first) if first != cell => {
                                return Err(row.fault(
                                    offset,
                                    Fault::TwoStarts {
                                        first,
                                        second: cell,
                                    },
                                ));
                            }
                            _ => {}
                        },
                        'G' | 'g' => goals.push(cell),
                        _ => return Err(row.unexpected(offset, "a blank, `S` or `G` in a cell")),
                    }
                }
            }
            let (cell, at) = (Cell::new(grid.width() - 1, y), width * PITCH);
            maze.set_wall(cell, Direction::East, row.vertical(width)?);
            row.border(&maze, cell, Direction::East, at)?;
        }
        row.nothing_beyond(width)?;
    }

    maze.set_start(start.map(|cell| (cell, Direction::North)));
    maze.set_goals(goals);
    Ok(Parsed::new(maze, places))
}

/// Draws `maze`, north first, every line ended by a line feed.
pub(crate) fn draw(maze: &Maze, out: &mut impl fmt::Write) -> fmt::Result {
    let grid = maze.grid();
    let posts = |out: &mut dyn fmt::Write, y: u16, side: Direction| {
        for x in 0..grid.width() {
            out.write_str(if maze.is_open(Cell::new(x, y), side) {
                "o   "
            } else {
                "o---"
            })?;
        }
        out.write_str("o\n")
    };
    for y in (0..grid.height()).rev() {
        posts(out, y, Direction::North)?;
        for x in 0..grid.width() {
            let cell = Cell::new(x, y);
            out.write_char(if maze.is_open(cell, Direction::West) {
                ' '
            } else {
                '|'
            })?;
            let is_start = maze.start().is_some_and(|(start, _)| start == cell);
            let is_goal = maze.goals().binary_search(&cell).is_ok();
            out.write_str(match (is_start, is_goal) {
                (true, true) => "S G",
                (true, false) => " S ",
                (false, true) => " G ",
                (false, false) => "   ",
            })?;
        }
        let east = Cell::new(grid.width().saturating_sub(1), y);
        out.write_str(if maze.is_open(east, Direction::East) {
            " \n"
        } else {
            "|\n"
        })?;
    }
    posts(out, 0, Direction::South)
}

/// A line of a drawing. Offsets count characters from the drawing's west border.
struct Row<'a> {
    line: Line<'a>,
    /// Blanks before the west border.
    indent: usize,
}

/// The lines that belong to the drawing. All are indented like the first.
fn rows<'a>(lines: &mut Lines<'a>) -> Result<Vec<Row<'a>>, MazeError> {
    let mut rows: Vec<Row<'a>> = Vec::new();
    loop {
        let mut ahead = lines.clone();
        let Some(line) = ahead.next() else {
            return Ok(rows);
        };
        if line.is_blank() {
            return Ok(rows);
        }
        let blanks = line.text.len() - line.text.trim_start_matches(' ').len();
        let indent = rows.first().map_or(blanks, |row| row.indent);
        let first = line.text.get(indent..).and_then(|text| text.chars().next());
        match first {
            Some('\t') => return Err(line.fault(indent, Fault::Tab)),
            Some(c) if blanks >= indent && (is_post(c) || matches!(c, '|' | ' ')) => {
                rows.push(Row { line, indent });
                *lines = ahead;
            }
            Some(_) if rows.is_empty() => {
                return Err(Row { line, indent }.unexpected(0, POST));
            }
            _ => return Ok(rows),
        }
    }
}

/// How many columns the first line of a drawing has posts for; at least one, so that whatever is
/// wrong with the first is found where it is.
fn width(first: &Row<'_>) -> usize {
    (1..)
        .take_while(|column| is_post(first.char(column * PITCH)))
        .count()
        .max(1)
}

const POST: &str = "a post, `o` or `+`, at every corner of a cell";

impl Row<'_> {
    /// The character at `offset`; lines go on with blanks after their end.
    fn char(&self, offset: usize) -> char {
        let bytes = self.line.text.as_bytes();
        match bytes.get(self.indent + offset) {
            None => ' ',
            Some(byte) if byte.is_ascii() => char::from(*byte),
            Some(_) => char::REPLACEMENT_CHARACTER,
        }
    }

    fn place(&self, offset: usize) -> Place {
        // Everything left of a place in a drawing is ASCII: the first character that is not is an
        // error. So bytes are columns, also where a short line has no character any more.
        self.line.place(0).right(self.indent + offset)
    }

    fn fault(&self, offset: usize, fault: Fault) -> MazeError {
        self.place(offset).fault(fault)
    }

    fn unexpected(&self, offset: usize, expected: &'static str) -> MazeError {
        let found = self
            .line
            .text
            .get(self.indent + offset..)
            .and_then(|text| text.chars().next());
        self.fault(
            offset,
            match found {
                Some('\t') => Fault::Tab,
                found => Fault::Character {
                    found: found.unwrap_or('\n'),
                    expected,
                },
            },
        )
    }

    fn post(&self, column: usize) -> Result<(), MazeError> {
        let offset = column * PITCH;
        if is_post(self.char(offset)) {
            Ok(())
        } else {
            Err(self.unexpected(offset, POST))
        }
    }

    /// Whether the wall after the post of `column` stands.
    fn horizontal(&self, column: usize) -> Result<bool, MazeError> {
        let first = column * PITCH + 1;
        let stands = self.char(first) == '-';
        let drawn = if stands { '-' } else { ' ' };
        match (first..first + 3).find(|offset| self.char(*offset) != drawn) {
            None => Ok(stands),
            Some(offset) => Err(self.unexpected(offset, "`---` or three blanks between two posts")),
        }
    }

    /// Whether the wall before the cell of `column` stands.
    fn vertical(&self, column: usize) -> Result<bool, MazeError> {
        let offset = column * PITCH;
        match self.char(offset) {
            '|' => Ok(true),
            ' ' => Ok(false),
            _ => Err(self.unexpected(offset, "`|` or a blank between two cells")),
        }
    }

    fn border(&self, maze: &Maze, cell: Cell, side: Direction, at: usize) -> Result<(), MazeError> {
        if maze.grid().neighbour(cell, side).is_none() && maze.is_open(cell, side) {
            let fault = Fault::Maze(crate::CheckError::OpenBorder {
                cell,
                direction: side,
            });
            return Err(self.fault(at, fault));
        }
        Ok(())
    }

    /// Beyond the east border remarks may stand, but no walls: those belong to a wider maze.
    fn nothing_beyond(&self, width: usize) -> Result<(), MazeError> {
        let offset = width * PITCH + 1;
        match self.line.text.get(self.indent + offset..) {
            Some(rest) if rest.contains('|') || rest.contains("--") => {
                Err(self.fault(offset, Fault::BeyondBorder { width }))
            }
            _ => Ok(()),
        }
    }
}
