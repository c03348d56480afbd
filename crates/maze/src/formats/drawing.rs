//! The drawing of posts and walls that the `mazefiles` collection, mms and tolman's own files
//! share.

use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use super::lines::{Line, Lines, Place};
use super::{MazeError, MazeFault, MazeFile, Parsed, edge};
use crate::{Cell, CheckError, Direction, Grid, Knowledge, Maze};

/// Number of characters from one post to the next in drawings that are written.
const PITCH: usize = 4;

/// Returns whether a drawing begins with this line, which has no blanks before it. Double borders
/// are not walls, but count as a drawing.
pub(super) fn begins(line: &str) -> bool {
    let mut chars = line.chars();
    chars.next().is_some_and(is_post) && chars.next().is_none_or(|c| matches!(c, '-' | ' ' | '='))
}

const fn is_post(c: char) -> bool {
    matches!(c, 'o' | '+')
}

/// Returns whether a wall begins with this text, which has no blanks before it.
fn begins_wall(text: &str) -> bool {
    text.starts_with(['|', '-'])
        || text
            .strip_prefix(is_post)
            .is_some_and(|rest| rest.starts_with('-'))
}

/// Reads a drawing from its first line on, which `lines` must be about to give.
///
/// The drawing ends before the first line that starts with neither a post, a wall nor a blank; that
/// line is the next of `lines`. The start is where the `S` is, looking north.
pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    let rows = rows(lines)?;
    let Some((first, others)) = rows.split_first() else {
        return Err(MazeError::at_start(MazeFault::Empty));
    };
    let pitch = first.pitch;
    let width = width(first);
    let side = |side: usize| {
        let small = u16::try_from(side).ok();
        let small = small.filter(|side| *side <= Grid::MAX_SIDE);
        small.ok_or_else(|| first.line.fault(0, MazeFault::TooLarge { side }))
    };
    let grid = Grid::new(side(width)?, side(rows.len() / 2)?);
    if rows.len() < 3 || rows.len().is_multiple_of(2) {
        let last = rows.last().unwrap_or(first);
        return Err(match lines.clone().next().filter(|line| !line.is_blank()) {
            // No remark stands within a row.
            Some(line) => {
                let indent = first.indent.min(line.text.len());
                Row {
                    line,
                    indent,
                    pitch,
                }
                .unexpected(0, "a post, `|` or a blank at the west border")
            }
            None => (last.line).fault(0, MazeFault::Unfinished { lines: rows.len() }),
        });
    }

    let mut reader = Reader {
        maze: Maze::open(grid),
        places: vec![Place::default(); grid.cell_count()],
        start: None,
        goals: Vec::new(),
        landmarks: BTreeMap::new(),
        unknown: Vec::new(),
    };
    // Row y of the cells is line 2 · (height - 1 - y) + 1; the posts to its north are the line
    // before.
    let rows_of_cells = others.chunks(2).zip((0..grid.height()).rev());
    reader.posts(first, grid.height() - 1, Direction::North)?;
    for (pair, y) in rows_of_cells {
        if let [cells, posts] = pair {
            cells.reaches(width)?;
            reader.cells(cells, y)?;
            posts.reaches(width)?;
            reader.posts(posts, y, Direction::South)?;
        }
    }
    reader
        .maze
        .set_start(reader.start.map(|cell| (cell, Direction::North)));
    reader.maze.set_goals(reader.goals);
    reader.maze.set_landmarks(reader.landmarks);
    let mut parsed = Parsed {
        begin: first.place(0),
        ..Parsed::new(reader.maze, reader.places)
    };
    reader.unknown.sort_unstable();
    reader.unknown.dedup();
    parsed.file.unknown = reader.unknown;
    Ok(parsed)
}

/// Part of a drawing read so far.
struct Reader {
    maze: Maze,
    places: Vec<Place>,
    start: Option<Cell>,
    goals: Vec<Cell>,
    landmarks: BTreeMap<Cell, u32>,
    unknown: Vec<(Cell, Direction)>,
}

/// What may stand in a cell.
const MARKS: &str = "a blank, `S`, `G` or the number of one landmark, 1 to 8, in a cell";

impl Reader {
    /// Reads the line of posts on the `side` of the cells of row `y`.
    fn posts(&mut self, row: &Row<'_>, y: u16, side: Direction) -> Result<(), MazeError> {
        let width = self.maze.grid().width();
        for x in 0..width {
            row.expect_post(x)?;
            let stands = row.horizontal(x)?;
            self.wall(row, Cell::new(x, y), side, stands)?;
        }
        row.expect_post(width)?;
        row.nothing_beyond(width)
    }

    /// Reads the line of the cells of row `y`.
    fn cells(&mut self, row: &Row<'_>, y: u16) -> Result<(), MazeError> {
        let grid = self.maze.grid();
        for x in 0..grid.width() {
            let cell = Cell::new(x, y);
            self.wall(row, cell, Direction::West, row.vertical(x)?)?;
            if let Some(place) = self.places.get_mut(grid.index(cell)) {
                *place = row.place(row.middle(x));
            }
            for offset in row.post(x) + 1..row.post(x + 1) {
                match row.char(offset) {
                    ' ' => {}
                    'S' | 's' => {
                        if let Some(first) = self.start.replace(cell)
                            && first != cell
                        {
                            let second = cell;
                            return Err(row.fault(offset, MazeFault::TwoStarts { first, second }));
                        }
                    }
                    'G' | 'g' => self.goals.push(cell),
                    mark => {
                        let number = mark.to_digit(10).filter(|n| Maze::LANDMARKS.contains(n));
                        let landmark = number.filter(|_| !self.landmarks.contains_key(&cell));
                        let Some(landmark) = landmark else {
                            return Err(row.unexpected(offset, MARKS));
                        };
                        self.landmarks.insert(cell, landmark);
                    }
                }
            }
        }
        let east = row.vertical(grid.width())?;
        self.wall(row, Cell::new(grid.width() - 1, y), Direction::East, east)?;
        row.nothing_beyond(grid.width())
    }

    /// Records a wall or an opening, as `row` shows it on the given side of `cell`.
    fn wall(
        &mut self,
        row: &Row<'_>,
        cell: Cell,
        direction: Direction,
        knowledge: Knowledge,
    ) -> Result<(), MazeError> {
        let stands = knowledge == Knowledge::Wall;
        if !stands && self.maze.grid().neighbour(cell, direction).is_none() {
            let offset = match direction {
                Direction::North | Direction::South => row.middle(cell.x),
                Direction::West => row.post(cell.x),
                Direction::East => row.post(cell.x + 1),
            };
            let fault = MazeFault::Maze(CheckError::OpenBorder { cell, direction });
            return Err(row.fault(offset, fault));
        }
        self.maze.set_wall(cell, direction, stands);
        if knowledge == Knowledge::Unknown {
            self.unknown.push(edge(cell, direction));
        }
        Ok(())
    }
}

/// Returns the drawing of a maze, with a `.` for each unknown wall.
pub(super) fn text(file: &MazeFile) -> String {
    let mut text = file.maze.to_string();
    let grid = file.maze.grid();
    // Every character of a drawing is one byte.
    let line = PITCH * usize::from(grid.width()) + 2;
    for (cell, direction) in &file.unknown {
        let (x, row) = (usize::from(cell.x), usize::from(grid.height() - 1 - cell.y));
        let at = match direction {
            Direction::North => 2 * row * line + x * PITCH + PITCH / 2,
            _ => (2 * row + 1) * line + (x + 1) * PITCH,
        };
        if at < text.len() {
            text.replace_range(at..=at, ".");
        }
    }
    text
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
            let landmark = maze.landmarks().get(&cell);
            let landmark = landmark.and_then(|number| char::from_digit(*number, 10));
            let marks = [is_start.then_some('S'), landmark, is_goal.then_some('G')];
            let [west, middle, east] = match marks {
                [Some(mark), None, None] | [None, None, Some(mark)] => [' ', mark, ' '],
                [Some(start), Some(landmark), None] => [start, ' ', landmark],
                [None, Some(landmark), Some(goal)] => [landmark, ' ', goal],
                marks => marks.map(|mark| mark.unwrap_or(' ')),
            };
            for mark in [west, middle, east] {
                out.write_char(mark)?;
            }
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
    /// Number of blanks before the west border.
    indent: usize,
    /// Number of characters from one post to the next.
    pitch: usize,
}

/// Returns the lines that belong to the drawing. All are indented like the first.
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
        let text = if blanks < indent {
            ""
        } else {
            &line.text[indent..]
        };
        if text.starts_with('\t') {
            return Err(line.fault(indent, MazeFault::Tab));
        }
        // A remark below the drawing may also begin with an `o`: `begins` looks at the next
        // character.
        let pitch = rows.first().map_or_else(|| pitch(text), |row| row.pitch);
        if begins(text) || text.starts_with(['|', ' ']) {
            rows.push(Row {
                line,
                indent,
                pitch,
            });
            *lines = ahead;
        } else if rows.is_empty() {
            return Err(Row {
                line,
                indent,
                pitch,
            }
            .unexpected(0, POST));
        } else {
            return Ok(rows);
        }
    }
}

/// Returns the number of characters from the first post of a line to the second.
fn pitch(first: &str) -> usize {
    let second = first.chars().skip(1).position(is_post);
    second.map_or(PITCH, |at| at + 1).max(2)
}

/// Returns the number of columns for which the first line of a drawing has posts. It is at least
/// one, so that a fault in the first column is reported at its place.
fn width(first: &Row<'_>) -> usize {
    (1..)
        .take_while(|column| is_post(first.char(column * first.pitch)))
        .count()
        .max(1)
}

const POST: &str = "a post, `o` or `+`, at every corner of a cell";

const HORIZONTAL: &str = "`---`, three blanks or ` . ` between two posts, all as far apart as the first two, as in `+---+---+`";

impl Row<'_> {
    /// Returns the column of characters of the post to the west of a cell's column.
    const fn post(&self, column: u16) -> usize {
        column as usize * self.pitch
    }

    /// Returns the column of characters of the middle of a cell's column.
    const fn middle(&self, column: u16) -> usize {
        self.post(column) + self.pitch / 2
    }

    /// Returns the character at `offset`; blanks beyond the end of the line.
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

    fn fault(&self, offset: usize, fault: MazeFault) -> MazeError {
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
                Some('\t') => MazeFault::Tab,
                found => MazeFault::Character {
                    found: found.unwrap_or('\n'),
                    expected,
                },
            },
        )
    }

    /// Expects the post to the west of `column`.
    fn expect_post(&self, column: u16) -> Result<(), MazeError> {
        if is_post(self.char(self.post(column))) {
            Ok(())
        } else {
            Err(self.unexpected(self.post(column), POST))
        }
    }

    /// Returns what this line of posts says of the wall along `column`.
    fn horizontal(&self, column: u16) -> Result<Knowledge, MazeError> {
        let mut offsets = self.post(column) + 1..self.post(column + 1);
        if offsets.clone().any(|offset| self.char(offset) == '.') {
            let other = offsets.find(|offset| !matches!(self.char(*offset), '.' | ' '));
            return other.map_or(Ok(Knowledge::Unknown), |offset| {
                Err(self.unexpected(offset, HORIZONTAL))
            });
        }
        let stands = self.char(offsets.start) == '-';
        let drawn = if stands { '-' } else { ' ' };
        match offsets.find(|offset| self.char(*offset) != drawn) {
            None => Ok(if stands {
                Knowledge::Wall
            } else {
                Knowledge::Open
            }),
            Some(offset) => Err(self.unexpected(offset, HORIZONTAL)),
        }
    }

    /// Returns what this line of cells says of the wall to the west of `column`.
    fn vertical(&self, column: u16) -> Result<Knowledge, MazeError> {
        let offset = self.post(column);
        match self.char(offset) {
            '|' => Ok(Knowledge::Wall),
            ' ' => Ok(Knowledge::Open),
            '.' => Ok(Knowledge::Unknown),
            _ => Err(self.unexpected(offset, "`|`, a blank or `.` between two cells")),
        }
    }

    /// Checks that a line reaches the border, which is closed.
    fn reaches(&self, width: usize) -> Result<(), MazeError> {
        let drawn = self.line.text.get(self.indent..).unwrap_or_default();
        let found = drawn.chars().count();
        // A tab fakes a short line, and is found later.
        if found > width * self.pitch || drawn.contains('\t') {
            return Ok(());
        }
        Err(self.fault(
            found,
            MazeFault::TooShort {
                found,
                width,
                pitch: self.pitch,
            },
        ))
    }

    /// Checks that only remarks stand beyond the east border. What begins as a wall belongs to a
    /// wider maze.
    fn nothing_beyond(&self, width: u16) -> Result<(), MazeError> {
        let offset = self.post(width) + 1;
        match self.line.text.get(self.indent + offset..) {
            Some(rest) if begins_wall(rest.trim_start()) => Err(self.fault(
                offset,
                MazeFault::BeyondBorder {
                    width,
                    pitch: self.pitch,
                },
            )),
            _ => Ok(()),
        }
    }
}
