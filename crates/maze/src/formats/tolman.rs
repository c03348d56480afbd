//! [`Format::Tolman`](super::Format::Tolman): a header of `key = value` lines, then a drawing; the
//! page `docs/maze-format.md` explains it.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::error::excerpt;
use super::lines::{Line, Lines, Place};
use super::{MazeError, MazeFault, MazeFile, Parsed, WriteError, drawing};
use crate::{Cell, CheckError, Direction, Maze};

const FORMAT: &str = "format";
const NAME: &str = "name";
const CORRIDOR_WIDTH: &str = "corridor_width";
const START: &str = "start";
const DESTINATION: &str = "destination";

/// All keys, in the order they are written in.
pub(super) const KEYS: [&str; 5] = [FORMAT, NAME, CORRIDOR_WIDTH, START, DESTINATION];

/// The only valid value of `format` so far.
const VERSION: &str = "tolman maze 1";

pub(super) fn parse(lines: &mut Lines<'_>) -> Result<Parsed, MazeError> {
    let header = header(lines)?;
    let mut parsed = drawing::parse(lines)?;
    if let Some(line) = lines.find(|line| !line.is_blank() && !is_comment(line.text)) {
        return Err(line.fault(
            0,
            MazeFault::BelowDrawing {
                found: excerpt(line.text.trim()),
            },
        ));
    }
    for entry in header {
        entry.apply(&mut parsed.file)?;
    }
    Ok(parsed)
}

pub(super) fn write(file: &MazeFile) -> Result<String, WriteError> {
    let mut text = format!("{FORMAT} = {VERSION}\n");
    if let Some(name) = &file.name {
        if name.contains(char::is_control) {
            return Err(WriteError::Name { name: name.clone() });
        }
        // Quoted, so that blanks at its ends and quotes within survive.
        text.push_str(&format!("{NAME} = \"{name}\"\n"));
    }
    if let Some(width) = file.corridor_width {
        if !is_width(width) {
            return Err(WriteError::CorridorWidth { width });
        }
        text.push_str(&format!("{CORRIDOR_WIDTH} = {width}\n"));
    }
    // The drawing marks start and destination; the header adds the heading the mark does not stand
    // for.
    if let Some((cell, heading)) = file.maze.start()
        && heading != Direction::North
    {
        text.push_str(&format!("{START} = {} {} {heading}\n", cell.x, cell.y));
    }
    text.push_str(&format!("\n{}", drawing::text(file)));
    Ok(text)
}

/// A `key = value` line.
struct Entry<'a> {
    key: &'static str,
    value: &'a str,
    /// Place of the value.
    place: Place,
}

/// Reads all lines up to the drawing.
fn header<'a>(lines: &mut Lines<'a>) -> Result<Vec<Entry<'a>>, MazeError> {
    let mut entries: Vec<Entry<'a>> = Vec::new();
    loop {
        let mut ahead = lines.clone();
        let Some(line) = ahead.next() else {
            return Err(Line {
                number: lines.read(),
                text: "",
            }
            .fault(0, MazeFault::NoDrawing));
        };
        let text = line.text.trim();
        if drawing::begins(text) {
            return Ok(entries);
        }
        if !text.is_empty() && !is_comment(text) {
            let entry = Entry::parse(line, text)?;
            if let Some(first) = entries.iter().find(|first| first.key == entry.key) {
                let fault = MazeFault::RepeatedKey {
                    key: entry.key,
                    first_line: first.place.line(),
                };
                return Err(line.place_of(text).fault(fault));
            }
            entries.push(entry);
        }
        *lines = ahead;
    }
}

impl<'a> Entry<'a> {
    /// Reads `text`, all but the blanks of `line`.
    fn parse(line: Line<'a>, text: &'a str) -> Result<Self, MazeError> {
        let Some((key, value)) = text.split_once('=') else {
            let found = excerpt(text);
            return Err(line.place_of(text).fault(MazeFault::NotAKey { found }));
        };
        let (key, value) = (key.trim(), value.trim());
        let Some(key) = KEYS.into_iter().find(|known| *known == key) else {
            let found = excerpt(key);
            return Err(line.place_of(text).fault(MazeFault::UnknownKey { found }));
        };
        // A name may hold any sign; no other value has a `#` in it.
        let value = match value.split_once('#') {
            Some((value, _)) if key != NAME => value.trim_end(),
            _ => value,
        };
        Ok(Self {
            key,
            value,
            place: line.place_of(value),
        })
    }

    fn apply(&self, file: &mut MazeFile) -> Result<(), MazeError> {
        match self.key {
            NAME => file.name = Some(self.name()?),
            CORRIDOR_WIDTH => file.corridor_width = Some(self.width()?),
            START => self.mark_start(&mut file.maze)?,
            DESTINATION => self.mark_destination(&mut file.maze)?,
            // `format`, the only other of KEYS.
            _ if self.value == VERSION => {}
            _ => return Err(self.expected("`tolman maze 1`, the only version so far")),
        }
        Ok(())
    }

    fn expected(&self, expected: &'static str) -> MazeError {
        self.place.fault(MazeFault::Value {
            key: self.key,
            found: excerpt(self.value),
            expected,
        })
    }

    fn name(&self) -> Result<String, MazeError> {
        if self.value.is_empty() || self.value.contains(char::is_control) {
            return Err(self.expected("a line of text"));
        }
        let quoted = self
            .value
            .strip_prefix('"')
            .and_then(|value| value.strip_suffix('"'));
        Ok(quoted.unwrap_or(self.value).to_string())
    }

    fn width(&self) -> Result<f64, MazeError> {
        let width = self.value.parse().ok().filter(|width| is_width(*width));
        width.ok_or_else(|| self.expected("metres from 0.001 to 1000, a plain number as in `0.5`"))
    }

    fn mark_start(&self, maze: &mut Maze) -> Result<(), MazeError> {
        let bad = || {
            self.expected(
                "a column and a row, counted from 0 in the south-west corner, and the direction to \
                 look if it is not north, as in `0 0 east`",
            )
        };
        let (cell, heading) = match self.value.rsplit_once(is_separator) {
            Some((cell, word)) if word.starts_with(char::is_alphabetic) => {
                (cell, direction(word).ok_or_else(bad)?)
            }
            _ => (self.value, Direction::North),
        };
        let [cell] = cells(cell).ok_or_else(bad)?[..] else {
            return Err(bad());
        };
        if !maze.grid().contains(cell) {
            let fault = CheckError::StartOutside {
                start: cell,
                grid: maze.grid(),
            };
            return Err(self.place.fault(MazeFault::Maze(fault)));
        }
        match maze.start() {
            Some((drawing, _)) if drawing != cell => {
                Err(self.place.fault(MazeFault::StartDisagrees {
                    header: cell,
                    drawing,
                }))
            }
            _ => {
                maze.set_start(Some((cell, heading)));
                Ok(())
            }
        }
    }

    fn mark_destination(&self, maze: &mut Maze) -> Result<(), MazeError> {
        let drawing = maze.goals().to_vec();
        let cells = cells(self.value).ok_or_else(|| {
            self.expected(
                "a column and a row for each cell, counted from 0 in the south-west corner, as in \
                 `7 7` or `7 7, 8 7`",
            )
        })?;
        let grid = maze.grid();
        if let Some(goal) = cells.iter().find(|cell| !grid.contains(**cell)) {
            let fault = CheckError::GoalOutside { goal: *goal, grid };
            return Err(self.place.fault(MazeFault::Maze(fault)));
        }
        maze.set_goals(cells);
        if drawing.is_empty() || drawing == maze.goals() {
            return Ok(());
        }
        let header = maze.goals().to_vec();
        Err(self
            .place
            .fault(MazeFault::DestinationDisagrees { header, drawing }))
    }
}

fn is_comment(text: &str) -> bool {
    text.trim_start().starts_with('#')
}

fn is_width(width: f64) -> bool {
    (MazeFile::CORRIDOR_WIDTHS.0..=MazeFile::CORRIDOR_WIDTHS.1).contains(&width)
}

/// Returns whether `c` may stand between numbers: blanks, commas and brackets, as people write
/// coordinates.
fn is_separator(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | ';' | '(' | ')')
}

/// Returns one or more pairs of numbers.
fn cells(text: &str) -> Option<Vec<Cell>> {
    let numbers = text.split(is_separator).filter(|word| !word.is_empty());
    let numbers: Vec<u16> = numbers
        .map(|word| word.parse().ok())
        .collect::<Option<_>>()?;
    let pairs = numbers.chunks(2).map(|pair| match pair {
        [x, y] => Some(Cell::new(*x, *y)),
        _ => None,
    });
    pairs
        .collect::<Option<Vec<Cell>>>()
        .filter(|cells| !cells.is_empty())
}

fn direction(word: &str) -> Option<Direction> {
    Direction::ALL
        .into_iter()
        .find(|direction| direction.to_string().eq_ignore_ascii_case(word))
}
