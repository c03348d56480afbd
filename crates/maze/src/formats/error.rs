use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::Format;
use crate::{Cell, CheckError, Direction, Grid};

/// Reason why a text is not a maze, with the place of the fault.
///
/// The text has no file name; the caller that opened the file puts it before the message.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {fault}")]
pub struct MazeError {
    /// Number of the line, from 1.
    pub line: usize,
    /// Number of the character in the line, from 1.
    pub column: usize,
    /// Fault found at that place.
    pub fault: MazeFault,
}

impl MazeError {
    pub(super) fn at_start(fault: MazeFault) -> Self {
        super::Place::default().fault(fault)
    }
}

/// Fault of a maze file. Every message names the offending value and the repair.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MazeFault {
    /// The text is empty or blank.
    #[error("the file is empty: expected a maze")]
    Empty,
    /// The first line does not begin a maze file.
    #[error(
        "found `{found}`, with which no maze file begins: expected a drawing of posts `o` or `+` and \
         walls `---` and `|`, a `key = value` line before one, a grid of `#`, a drawing of `_` and `|`, a \
         size above rows of numbers, hexadecimal rows, or lines `X Y N E S W`; docs/maze-format.md shows how to \
         convert others"
    )]
    UnknownFormat {
        /// Beginning of the line.
        found: String,
    },

    /// A character of a drawing is in the wrong place.
    #[error("found {found:?}: expected {expected}")]
    Character {
        /// Character found: a line feed at the end of a line.
        found: char,
        /// Text that is allowed there, in words.
        expected: &'static str,
    },
    /// A line has a tab, whose width is unknown.
    #[error("found a tab: draw with blanks")]
    Tab,
    /// A line that ends before the east border.
    #[error(
        "the line is too short, {found} characters: the first line of the drawing has posts for {width} \
         columns, so expected {} (one every {pitch} characters, and the last): draw a rectangle, and wall off the \
         rest",
        width * pitch + 1
    )]
    TooShort {
        /// Number of characters in the line.
        found: usize,
        /// Number of columns that the drawing's first line has posts for.
        width: usize,
        /// Number of characters from one post to the next.
        pitch: usize,
    },
    /// A line extends beyond the east border.
    #[error(
        "the drawing goes on beyond the east border: its first line has posts for {width} columns \
         (one every {pitch} characters); draw a rectangle, and wall off the rest"
    )]
    BeyondBorder {
        /// Number of columns that the drawing's first line has posts for.
        width: u16,
        /// Number of characters from one post to the next.
        pitch: usize,
    },
    /// A line of a grid with another length than the first.
    #[error(
        "the line has {found} characters, and the first has {width}: make all lines as long as the first"
    )]
    Ragged {
        /// Number of characters in the line.
        found: usize,
        /// Number of characters in the first line.
        width: usize,
    },
    /// A grid of blocks in which walls are not on every second line and column.
    #[error(
        "a grid of {columns} × {rows} blocks is no maze of cells: walls have to be on the first and every second \
         line and column after it, and floors between them; draw walls as lines between cells"
    )]
    NoLattice {
        /// Number of blocks in a line.
        columns: usize,
        /// Number of lines.
        rows: usize,
    },
    /// A text that is no binary maze.
    #[error(
        "a `.maz` file has 256 or 1024 bytes, one for each cell: give a file of another format by its text"
    )]
    NotMaz,
    /// A drawing without its last line.
    #[error(
        "the drawing stops in the middle of a row, with its line {lines}: n rows of cells take 2n + 1 \
         lines, the last of them the south border"
    )]
    Unfinished {
        /// Number of lines of the drawing.
        lines: usize,
    },
    /// The drawing has a second `S`.
    #[error("the start is marked twice, in {first} and in {second}: keep one `S`")]
    TwoStarts {
        /// Cell of the first mark.
        first: Cell,
        /// Cell of the second mark.
        second: Cell,
    },

    /// A text is not the number that belongs in its place.
    #[error("found `{found}`: expected {expected}")]
    Number {
        /// Text found there.
        found: String,
        /// Text that is allowed there, in words.
        expected: &'static str,
    },
    /// Too few or too many lines or items.
    #[error("found {found} {what}, expected {expected}: {repair}")]
    Count {
        /// Number found; of lines and items beyond the last one, only the first is counted.
        found: usize,
        /// Number of lines or items expected.
        expected: usize,
        /// Kind of the counted things.
        what: &'static str,
        /// Advice on the repair.
        repair: &'static str,
    },
    /// A side of the maze is longer than [`Grid::MAX_SIDE`].
    #[error(
        "a side of {side} cells is too long: mazes of up to {} are read",
        Grid::MAX_SIDE
    )]
    TooLarge {
        /// Length of the longer side, cells.
        side: usize,
    },
    /// Two cells contradict each other about the wall between them.
    #[error(
        "cell {cell} is {} to the {direction}, but {neighbour} beyond is {} to the {}: make the two \
         agree", side(*open), side(!*open), direction.opposite()
    )]
    Disagree {
        /// Cell at this place.
        cell: Cell,
        /// Side of `cell` on which the wall is.
        direction: Direction,
        /// Whether the text calls that side of `cell` open.
        open: bool,
        /// Cell on the other side of the wall.
        neighbour: Cell,
    },
    /// A cell listed twice.
    #[error("cell {cell} was already given on line {first_line}: keep one of the two lines")]
    Duplicate {
        /// Cell that is given twice.
        cell: Cell,
        /// Line of its first mention.
        first_line: usize,
    },
    /// A cell that is not listed.
    #[error(
        "cell {cell} of the {} × {} maze is missing: add a line for it",
        grid.width(), grid.height()
    )]
    Missing {
        /// First missing cell, row by row from the south-west.
        cell: Cell,
        /// Size of the maze by the cells that are listed.
        grid: Grid,
    },

    /// There is a header and no drawing below it.
    #[error(
        "the drawing is missing: draw the maze below the header, with posts and walls as in `+---+` \
         and `|`; lines that start with `#` are comments: redraw a maze of blocks so that its walls are lines \
         between cells"
    )]
    NoDrawing,
    /// A line before the drawing that is not `key = value`.
    #[error("found `{found}`: expected `key = value`, a comment after `#`, or the drawing")]
    NotAKey {
        /// Beginning of the line.
        found: String,
    },
    /// A key that no maze file has.
    #[error("`{found}` is not a key of a maze file: use {}", super::tolman::KEYS.join(", "))]
    UnknownKey {
        /// Key that was given.
        found: String,
    },
    /// A key given twice.
    #[error("`{key}` was already given on line {first_line}: keep one of the two lines")]
    RepeatedKey {
        /// Name of the key.
        key: &'static str,
        /// Line of its first mention.
        first_line: usize,
    },
    /// A value that its key cannot have.
    #[error("found `{found}` for `{key}`: expected {expected}")]
    Value {
        /// Name of the key.
        key: &'static str,
        /// Value that was given.
        found: String,
        /// Values that the key may have.
        expected: &'static str,
    },
    /// The header and the drawing have different starts.
    #[error("`start` is {header}, but the drawing has its `S` in {drawing}: drop one of the two")]
    StartDisagrees {
        /// Start by the header.
        header: Cell,
        /// Start by the mark in the drawing.
        drawing: Cell,
    },
    /// The header and the drawing have different destinations.
    #[error(
        "`destination` is {}, but the drawing has its `G` in {}: drop one of the two",
        Cells(header),
        Cells(drawing)
    )]
    DestinationDisagrees {
        /// Destination by the header.
        header: Vec<Cell>,
        /// Destination by the marks in the drawing.
        drawing: Vec<Cell>,
    },
    /// Text below the drawing of a tolman maze.
    #[error("found `{found}` below the drawing: put it above, or after a `#`")]
    BelowDrawing {
        /// Beginning of the line.
        found: String,
    },

    /// The text is well-formed, but its maze cannot be used.
    #[error(transparent)]
    Maze(#[from] CheckError),
}

impl MazeFault {
    pub(super) fn unknown_format(found: &str) -> Self {
        Self::UnknownFormat {
            found: excerpt(found),
        }
    }

    pub(super) fn number(found: &str, expected: &'static str) -> Self {
        Self::Number {
            found: excerpt(found),
            expected,
        }
    }
}

/// Reason why a format cannot hold a maze.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// No format holds a maze with an open border or with marks outside.
    #[error(transparent)]
    Maze(#[from] CheckError),
    /// A side of the maze is longer than [`Grid::MAX_SIDE`], so the text could not be read again.
    #[error(
        "a side of {side} cells is too long: mazes of up to {} are written",
        Grid::MAX_SIDE
    )]
    TooLarge {
        /// Length of the longer side, cells.
        side: u16,
    },
    /// The formats [`Format::Numbers`] and [`Format::Maz`] hold only squares of some sizes.
    #[error(
        "the format `{format}` cannot hold a maze of {} × {} cells: it needs a square of {}; \
         write it as `{}`", grid.width(), grid.height(),
        if *format == Format::Maz { "16 or 32 cells a side" } else { "even size" }, Format::Tolman
    )]
    Shape {
        /// Format to write.
        format: Format,
        /// Size of the maze.
        grid: Grid,
    },
    /// The format cannot hold the start.
    #[error(
        "the format `{format}` cannot hold {}: {}; write it as `{}`",
        Start(*start), start_rule(*format), Format::Tolman
    )]
    Start {
        /// Format to write.
        format: Format,
        /// Start of the maze: cell and heading.
        start: Option<(Cell, Direction)>,
    },
    /// The format cannot hold the goals.
    #[error(
        "the format `{format}` cannot hold the goals {}: they are always the middle, {}; write it as \
         `{}`",
        Cells(goals),
        Cells(middle),
        Format::Tolman
    )]
    Goals {
        /// Format to write.
        format: Format,
        /// Goals of the maze.
        goals: Vec<Cell>,
        /// Goals that every maze of the format has.
        middle: Vec<Cell>,
    },
    /// The format cannot hold unknown walls.
    #[error(
        "the format `{format}` cannot hold unknown walls: write it as `{}`",
        Format::Tolman
    )]
    Unknown {
        /// Format to write.
        format: Format,
    },
    /// The format cannot hold landmarks.
    #[error(
        "the format `{format}` cannot hold landmarks: write it as `{}`",
        Format::Tolman
    )]
    Landmarks {
        /// Format to write.
        format: Format,
    },
    /// A name that does not fit one line.
    #[error(
        "the name {name:?} has a line break or another control character: a maze's name is one line \
         of text"
    )]
    Name {
        /// Name that was given.
        name: String,
    },
    /// A corridor width outside [`MazeFile::CORRIDOR_WIDTHS`](crate::MazeFile::CORRIDOR_WIDTHS).
    #[error("the corridor width is {width} m; give 0.001 to 1000 m")]
    CorridorWidth {
        /// Width that was given, m.
        width: f64,
    },
}

/// The name is not the name of a [`Format`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` is not a maze format: use {}", Format::ALL.map(Format::name).join(", "))]
pub struct UnknownFormat {
    /// Name that was given.
    pub name: String,
}

/// Returns the side of a grid that is too long to be read or written, or `None`.
pub(super) fn too_large(grid: Grid) -> Option<u16> {
    Some(grid.width().max(grid.height())).filter(|side| *side > Grid::MAX_SIDE)
}

/// Returns the beginning of a text without control characters. Lines of a file may have any length,
/// and a terminal would obey control characters.
pub(super) fn excerpt(text: &str) -> String {
    const LIMIT: usize = 40;
    let mut short = String::new();
    for c in text.chars().take(LIMIT) {
        if c.is_control() {
            short.extend(c.escape_default());
        } else {
            short.push(c);
        }
    }
    if text.chars().nth(LIMIT).is_some() {
        short.push('…');
    }
    short
}

const fn side(open: bool) -> &'static str {
    if open { "open" } else { "walled" }
}

const fn start_rule(format: Format) -> &'static str {
    match format {
        Format::Mazefiles => "it has an S that looks north",
        Format::Blocks => "it has an S that looks north, and a G elsewhere",
        _ => "its start is always (0, 0) looking north",
    }
}

struct Start(Option<(Cell, Direction)>);

impl fmt::Display for Start {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some((cell, heading)) => write!(formatter, "the start {cell} looking {heading}"),
            None => formatter.write_str("a maze without a start"),
        }
    }
}

/// The first few cells of a list.
struct Cells<'a>(&'a [Cell]);

impl fmt::Display for Cells<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 8;
        if self.0.is_empty() {
            return formatter.write_str("none");
        }
        for (index, cell) in self.0.iter().take(SHOWN).enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(formatter, "{comma}{cell}")?;
        }
        if self.0.len() > SHOWN {
            formatter.write_str(", …")
        } else {
            Ok(())
        }
    }
}
