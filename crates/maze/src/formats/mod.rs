//! The text formats, one file each; detection and the entry points here.

// Files hold any bytes: a reader indexes nothing and cuts no number off.
#![cfg_attr(
    not(test),
    warn(clippy::indexing_slicing, clippy::cast_possible_truncation)
)]
mod blocks;
mod boxes;
mod drawing;
mod error;
mod hex;
mod lines;
mod maz;
mod mazefiles;
mod num;
mod numbers;
mod sides;
mod tolman;
mod underscores;

use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

pub(crate) use drawing::draw;
pub use error::{MazeError, MazeFault, UnknownFormat, WriteError};
use lines::{Lines, Place};
pub use maz::maz_text;

use crate::motion::Motion;
use crate::{Cell, Direction, Grid, Knowledge, Maze, Walls};

/// Contents of a maze file: the maze, and additions that only tolman's own format can hold.
///
/// ```
/// use tolman_maze::{Format, MazeFile, read, write};
///
/// let text = "\
/// name = Two rooms
/// corridor_width = 0.5
///
/// +---+---+
/// | S   G |
/// +---+---+
/// ";
/// let file: MazeFile = read(text).unwrap();
/// assert_eq!(file.name.as_deref(), Some("Two rooms"));
/// assert_eq!(file.corridor_width, Some(0.5));
/// assert_eq!(write(&file, Format::Mazefiles).unwrap(), "o---o---o\n| S   G |\no---o---o\n");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MazeFile {
    /// Name of the maze.
    pub name: Option<String>,
    /// The side of a cell, m, within [`MazeFile::CORRIDOR_WIDTHS`]. `None` leaves it to the world
    /// that is built.
    pub corridor_width: Option<f64>,
    /// The maze itself. Unknown walls are open in it.
    pub maze: Maze,
    /// Edges between two cells of which the text does not say whether a wall stands there, each by
    /// its western or southern cell.
    pub unknown: Vec<(Cell, Direction)>,
    /// Whether the text marks no goal, and the middle of the maze was taken.
    pub goal_is_assumed: bool,
}

/// What the text says of each wall.
impl Walls for MazeFile {
    fn grid(&self) -> Grid {
        self.maze.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        match self.unknown.binary_search(&edge(cell, direction)) {
            Ok(_) => Knowledge::Unknown,
            Err(_) => self.maze.knowledge(cell, direction),
        }
    }
}

/// Returns the edge by its western or southern cell.
fn edge(cell: Cell, direction: Direction) -> (Cell, Direction) {
    match direction {
        Direction::North | Direction::East => (cell, direction),
        _ => (cell.beyond(direction).unwrap_or(cell), direction.opposite()),
    }
}

impl MazeFile {
    /// Minimum and maximum corridor width that is read or written, m. A corridor that no robot fits
    /// through is a typing error, and huge widths break the arithmetic of worlds.
    pub const CORRIDOR_WIDTHS: (f64, f64) = (0.001, 1000.0);

    /// Returns the file with its maze turned by a quarter clockwise.
    #[must_use]
    pub fn rotated(self) -> Self {
        self.moved(Motion::Quarter)
    }

    /// Returns the file with its maze mirrored, west to east.
    #[must_use]
    pub fn mirrored(self) -> Self {
        self.moved(Motion::Mirror)
    }

    fn moved(mut self, motion: Motion) -> Self {
        let grid = self.maze.grid();
        for (cell, side) in &mut self.unknown {
            (*cell, *side) = edge(motion.cell(grid, *cell), motion.direction(*side));
        }
        self.unknown.sort_unstable();
        self.maze = self.maze.moved(motion);
        self
    }
}

impl From<Maze> for MazeFile {
    /// Returns a maze without a name, in corridors of no stated width.
    fn from(maze: Maze) -> Self {
        Self {
            name: None,
            corridor_width: None,
            maze,
            unknown: Vec::new(),
            goal_is_assumed: false,
        }
    }
}

/// A text format of mazes. It is displayed as, and parsed from, its name, such as `numbers` or
/// `mazefiles`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// The numbers of the micromouse paper's test program. Line 1 is the size n, an even number.
    /// Each further line is a column, from the west, with n comma-separated numbers, from the
    /// south. A number is the sum of the open sides of its cell: 1 north, 2 east, 4 south, 8 west.
    /// Squares only; the start is the south-west cell, looking north; the goal is the middle 2 × 2.
    Numbers,
    /// A drawing as in the `mazefiles` collection: 2h + 1 lines of 4w + 1 characters, north first.
    /// Posts are `o` or `+`, walls `---` and `|`, marks `S` and `G`. Cells may have other widths
    /// than three characters, and a `.` is an unknown wall.
    /// Without an `S` the start is the south-west cell; it looks north. Without a `G` the goal is
    /// the middle. The drawing ends at the first line that starts with
    /// neither a post, a wall nor a blank; the rest is ignored.
    Mazefiles,
    /// The drawing of [`Format::Mazefiles`] in box characters, such as `┌───┐`. Posts may be left
    /// out where a line runs through or none ends.
    Boxes,
    /// The `.num` files of the simulator mms: a line `X Y N E S W` for each cell, 1 where a wall
    /// stands. The start is the south-west cell, looking north; the goal is the middle.
    Num,
    /// tolman's own file for corridor worlds: `key = value` lines, then a drawing.
    /// `docs/maze-format.md` describes it in full.
    Tolman,
    /// A grid of blocks, each one or two characters wide: `#`, `@`, `█` or `1` is a wall, a blank,
    /// `.` or `0` a floor, `S` the start, `G` or `E` the goal. Walls are on every second line and
    /// column. Maps of moving-AI (`type octile`) are such grids below four lines.
    Blocks,
    /// A drawing of `_` and `|`, two characters a cell. Start and goal may be marked by `S` and `G`
    /// in cells without a wall in the south.
    Underscores,
    /// A line of hexadecimal digits for each row of cells, north first. A digit is the sum of the
    /// walls of its cell: 1 north, 2 east, 4 south, 8 west. Below may stand the start and the goal,
    /// as column and row from the north-west.
    Hex,
    /// Binary `.maz` files of micromice: 256 or 1024 bytes, one for each cell, column by column
    /// from the south-west. A byte is the sum of the walls of its cell, as in [`Format::Hex`].
    /// [`maz_text`] makes a text of the bytes.
    Maz,
}

impl Format {
    /// All formats that can be read and written.
    pub const ALL: [Self; 9] = [
        Self::Numbers,
        Self::Mazefiles,
        Self::Boxes,
        Self::Num,
        Self::Tolman,
        Self::Blocks,
        Self::Underscores,
        Self::Hex,
        Self::Maz,
    ];

    /// Returns the name as typed on a command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Numbers => "numbers",
            Self::Mazefiles => "mazefiles",
            Self::Boxes => "boxes",
            Self::Num => "num",
            Self::Tolman => "tolman",
            Self::Blocks => "blocks",
            Self::Underscores => "underscores",
            Self::Hex => "hex",
            Self::Maz => "maz",
        }
    }

    /// Returns the usual file extension, without the dot. Several formats share `txt`;
    /// [`Format::detect`] finds the format by the text.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Maz => "maz",
            Self::Num => "num",
            Self::Tolman => "maze",
            _ => "txt",
        }
    }

    /// Returns the format of `text`, by its first line that is not blank. A `key = value` or a
    /// comment is [`Format::Tolman`], a post [`Format::Mazefiles`] or [`Format::Boxes`]. One
    /// number, or numbers separated by commas, is [`Format::Numbers`]; several separated by blanks
    /// are [`Format::Num`].
    ///
    /// # Errors
    /// [`MazeFault::Empty`], or [`MazeFault::UnknownFormat`] with the line.
    ///
    /// ```
    /// use tolman_maze::Format;
    ///
    /// assert_eq!(Format::detect("o---o---o\n").unwrap(), Format::Mazefiles);
    /// assert_eq!(Format::detect("12\n1,5,7\n").unwrap(), Format::Numbers);
    /// assert!(Format::detect("<html>").is_err());
    /// ```
    pub fn detect(text: &str) -> Result<Self, MazeError> {
        if maz::begins(text) {
            return Ok(Self::Maz);
        }
        let plain = &*boxes::plain(text);
        let mut lines = Lines::of(plain);
        let all = lines.clone();
        let line = lines
            .next_filled()
            .ok_or(MazeError::at_start(MazeFault::Empty))?;
        let first = line.text.trim();
        if drawing::begins(first) {
            Ok(if boxes::begins(text) {
                Self::Boxes
            } else {
                Self::Mazefiles
            })
        } else if blocks::begins(all.clone()) {
            Ok(Self::Blocks)
        } else if underscores::begins(first) {
            Ok(Self::Underscores)
        } else if hex::begins(all) {
            Ok(Self::Hex)
        } else if first.starts_with('#') || first.contains('=') {
            Ok(Self::Tolman)
        } else if first.contains(|c: char| !c.is_ascii_digit() && !matches!(c, ',' | ' ' | '\t')) {
            Err(line.place_of(first).fault(MazeFault::unknown_format(first)))
        } else if first.contains([' ', '\t']) && !first.contains(',') {
            Ok(Self::Num)
        } else {
            Ok(Self::Numbers)
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        let found = Self::ALL.into_iter().find(|format| format.name() == name);
        found.ok_or_else(|| UnknownFormat {
            name: name.to_string(),
        })
    }
}

/// Reads a maze file of any [`Format`] and checks that its maze can be solved.
///
/// # Errors
/// The first fault of the text (see [`parse`]) or of the maze (see [`Maze::check`]), with its line
/// and column.
///
/// ```
/// let text = "\
/// +---+---+
/// | S | G |
/// +---+---+
/// ";
/// assert_eq!(
///     tolman_maze::read(text).unwrap_err().to_string(),
///     "line 2, column 7: no way leads from the start (0, 0) to the goal (1, 0): open a wall between them",
/// );
/// ```
pub fn read(text: &str) -> Result<MazeFile, MazeError> {
    read_as(text, Format::detect(text)?)
}

/// Reads like [`read`] in a known format, and returns the maze.
///
/// # Errors
/// As [`read`].
pub fn read_as(text: &str, format: Format) -> Result<MazeFile, MazeError> {
    parsed(text, format)?.checked()
}

/// Reads a maze file of any [`Format`], whether or not its maze can be solved: for tools that show
/// or repair mazes. Everything else goes through [`read`].
///
/// # Errors
/// The first fault of the text, with its line and column: nothing is guessed.
pub fn parse(text: &str) -> Result<MazeFile, MazeError> {
    parse_as(text, Format::detect(text)?)
}

/// Parses like [`parse`] in a known format, and returns the maze.
///
/// # Errors
/// As [`parse`].
pub fn parse_as(text: &str, format: Format) -> Result<MazeFile, MazeError> {
    parsed(text, format).map(|parsed| parsed.file)
}

/// Returns the text of `file` in `format`: reading it gives the same maze again. The name and the
/// corridor width are left out where the format has no room for them, that is in all but
/// [`Format::Tolman`].
///
/// # Errors
/// [`WriteError`] names the part of the maze that the format cannot hold.
pub fn write(file: &MazeFile, format: Format) -> Result<String, WriteError> {
    file.maze.check_structure()?;
    let grid = file.maze.grid();
    if let Some(side) = error::too_large(grid) {
        return Err(WriteError::TooLarge { side });
    }
    if !matches!(format, Format::Mazefiles | Format::Boxes | Format::Tolman) {
        if !file.unknown.is_empty() {
            return Err(WriteError::Unknown { format });
        }
        if !file.maze.landmarks().is_empty() {
            return Err(WriteError::Landmarks { format });
        }
    }
    match format {
        Format::Numbers => numbers::write(&file.maze),
        Format::Mazefiles => mazefiles::write(file, format),
        Format::Boxes => mazefiles::write(file, format).map(|text| boxes::drawn(&text)),
        Format::Num => num::write(&file.maze),
        Format::Tolman => tolman::write(file),
        Format::Blocks => blocks::write(&file.maze),
        Format::Underscores => underscores::write(&file.maze),
        Format::Hex => hex::write(&file.maze),
        Format::Maz => maz::write(&file.maze),
    }
}

fn parsed(text: &str, format: Format) -> Result<Parsed, MazeError> {
    if format == Format::Maz && maz::begins(text) {
        return maz::parse(text);
    }
    let text = &*boxes::plain(text);
    let mut lines = Lines::of(text);
    if lines.clone().next_filled().is_none() {
        return Err(MazeError::at_start(MazeFault::Empty));
    }
    match format {
        Format::Numbers => numbers::parse(&mut lines),
        Format::Mazefiles | Format::Boxes => mazefiles::parse(&mut lines),
        Format::Num => num::parse(&mut lines),
        Format::Tolman => tolman::parse(&mut lines),
        Format::Blocks => blocks::parse(&mut lines),
        Format::Underscores => underscores::parse(&mut lines),
        Format::Hex => hex::parse(&mut lines),
        Format::Maz => Err(MazeError::at_start(MazeFault::NotMaz)),
    }
}

/// Contents of a text, with the place of each cell, for faults found only later.
struct Parsed {
    file: MazeFile,
    /// Places by [`Grid::index`](crate::Grid::index).
    places: Vec<Place>,
    /// Place where the cells begin.
    begin: Place,
}

impl Parsed {
    fn new(maze: Maze, places: Vec<Place>) -> Self {
        Self {
            file: maze.into(),
            places,
            begin: Place::default(),
        }
    }

    /// Takes the middle for the goal if none is marked.
    fn or_middle(mut self) -> Self {
        let maze = &mut self.file.maze;
        if maze.goals().is_empty() {
            maze.set_goals(maze.grid().middle().collect());
            self.file.goal_is_assumed = true;
        }
        self
    }

    fn checked(self) -> Result<MazeFile, MazeError> {
        let Err(error) = self.file.maze.check() else {
            return Ok(self.file);
        };
        let grid = self.file.maze.grid();
        let place = error
            .cell()
            .and_then(|cell| self.places.get(grid.index(cell)));
        Err(place
            .copied()
            .unwrap_or(self.begin)
            .fault(MazeFault::Maze(error)))
    }
}

/// Checks that start and goals are those of classic competitions. Formats that do not state them
/// can hold no others.
fn expect_classic(maze: &Maze, format: Format) -> Result<(), WriteError> {
    let mut goals: Vec<Cell> = maze.grid().middle().collect();
    goals.sort_unstable();
    if maze.start() != Some(CLASSIC_START) {
        Err(WriteError::Start {
            format,
            start: maze.start(),
        })
    } else if maze.goals() != goals {
        Err(WriteError::Goals {
            format,
            goals: maze.goals().to_vec(),
            middle: goals,
        })
    } else {
        Ok(())
    }
}

/// Start of runs in formats that have none.
const CLASSIC_START: (Cell, Direction) = (Cell::new(0, 0), Direction::North);
