use core::hash::{Hash, Hasher};
use std::hash::DefaultHasher;
use std::path::PathBuf;

use numpy::ndarray::Array2;
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use rand_chacha::ChaCha8Rng;
use tolman_arena::family::Family;
use tolman_maze::rand::SeedableRng;
use tolman_maze::{Cell, Direction, Format, Grid, Maze, MazeFile};
use tolman_planners::{Arcs, path_to};

use crate::errors::{reasons, refused, unread, wrong};
use crate::map::pictures;

/// A cell as Python writes it: column from the west, row from the south.
pub(crate) type CellTuple = (u16, u16);

/// A maze of square cells. A cell is a tuple: column from the west, row from the south, from 0.
///
/// Parameters
/// ----------
/// source : str, path or array
///     The text of a maze in any format that `tolman maze check` accepts, the path of its file, or
///     an array of walls as `to_array` returns it.
///
/// Raises
/// ------
/// ValueError
///     If it is no maze. The message names the line, or the row and column.
/// OSError
///     If the file cannot be read.
#[pyclass(name = "Maze", module = "tolman", frozen)]
pub(crate) struct PyMaze {
    pub(crate) name: String,
    pub(crate) file: MazeFile,
}

#[pymethods]
impl PyMaze {
    /// Reads a maze in any format that `tolman maze check` accepts. `source` is a text of several
    /// lines, the path of a file, or an array as [`Self::to_array`] returns it: 1 for a wall or a
    /// post, 0 where it is open.
    #[new]
    fn new(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (name, text) = if let Ok(text) = source.extract::<String>() {
            match text.trim_end().contains('\n') {
                true => ("maze".to_owned(), text),
                false => of_file(&PathBuf::from(text))?,
            }
        } else if let Ok(path) = source.extract::<PathBuf>() {
            of_file(&path)?
        } else {
            return Ok(Self {
                name: "maze".to_owned(),
                file: MazeFile::from(of_array(source)?),
            });
        };
        let file = tolman_maze::read(&text).map_err(|error| refused(&name, &error))?;
        let name = file.name.clone().unwrap_or(name);
        Ok(Self { name, file })
    }

    /// Generates a maze of a family.
    ///
    /// Parameters
    /// ----------
    /// family : str
    ///     Such as "perfect", "braided" or "office"; the error of a wrong name lists all.
    /// width, height : int
    ///     Number of columns and rows.
    /// seed : int
    ///     From 0. The same seed gives the same maze.
    ///
    /// Returns
    /// -------
    /// Maze
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such family, or it has no maze of this size.
    #[staticmethod]
    #[pyo3(signature = (family = "perfect", width = 8, height = 8, *, seed = 1))]
    fn generate(family: &str, width: u16, height: u16, seed: u64) -> PyResult<Self> {
        let found = self::family("family", family)?;
        let maze = (found.draw)((width, height), &mut ChaCha8Rng::seed_from_u64(seed));
        let maze = maze.map_err(|error| {
            wrong(format!(
                "width {width}, height {height}: {}",
                reasons(&*error)
            ))
        })?;
        Ok(Self {
            name: format!("{} {width}x{height}, seed {seed}", found.name),
            file: MazeFile::from(maze),
        })
    }

    /// Returns the name of the maze.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of columns.
    #[getter]
    fn width(&self) -> u16 {
        self.maze().grid().width()
    }

    /// Returns the number of rows.
    #[getter]
    fn height(&self) -> u16 {
        self.maze().grid().height()
    }

    /// Returns the cell that is marked as the start, or `None`.
    #[getter]
    fn start(&self) -> Option<CellTuple> {
        self.maze().start().map(|(cell, _)| tuple(cell))
    }

    /// Returns the cells that are marked as goals.
    #[getter]
    fn goals(&self) -> Vec<CellTuple> {
        self.maze().goals().iter().copied().map(tuple).collect()
    }

    /// Returns whether there is no wall between a cell and its neighbour.
    ///
    /// Parameters
    /// ----------
    /// cell : (int, int)
    ///     Column from the west and row from the south, from 0.
    /// direction : {"north", "east", "south", "west"}
    ///     Where the neighbour lies.
    ///
    /// Returns
    /// -------
    /// bool
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such cell or direction.
    fn is_open(&self, cell: CellTuple, direction: &str) -> PyResult<bool> {
        let cell = self.cell("cell", cell)?;
        Ok(self
            .maze()
            .is_open(cell, self::direction("direction", direction)?))
    }

    /// Returns the neighbours of a cell without a wall in between.
    ///
    /// Parameters
    /// ----------
    /// cell : (int, int)
    ///     Column from the west and row from the south, from 0.
    ///
    /// Returns
    /// -------
    /// list of (int, int)
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such cell.
    fn neighbours(&self, cell: CellTuple) -> PyResult<Vec<CellTuple>> {
        let cell = self.cell("cell", cell)?;
        Ok(self
            .maze()
            .neighbours(cell)
            .map(|(_, next)| tuple(next))
            .collect())
    }

    /// Returns the cells of a shortest path, including both ends, or `None` if no path exists.
    ///
    /// Parameters
    /// ----------
    /// start, goal : (int, int) or None
    ///     The ends. By default the path leads from the marked start to the nearest marked goal.
    ///
    /// Returns
    /// -------
    /// list of (int, int) or None
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such cell, or none is given and none is marked.
    #[pyo3(signature = (start = None, goal = None))]
    fn shortest_path(
        &self,
        start: Option<CellTuple>,
        goal: Option<CellTuple>,
    ) -> PyResult<Option<Vec<CellTuple>>> {
        let maze = self.maze();
        let grid = maze.grid();
        let start = match start {
            Some(start) => self.cell("start", start)?,
            None => maze
                .start()
                .map(|(cell, _)| cell)
                .ok_or_else(|| wrong("start: the maze marks none, so give one".to_owned()))?,
        };
        let goals = match goal {
            Some(goal) => vec![self.cell("goal", goal)?],
            None if maze.goals().is_empty() => {
                return Err(wrong("goal: the maze marks none, so give one".to_owned()));
            }
            None => maze.goals().to_vec(),
        };
        let arcs: Vec<_> = grid
            .cells()
            .flat_map(|cell| {
                let next = maze.neighbours(cell);
                next.map(move |(_, next)| (grid.index(cell) as u32, grid.index(next) as u32, 1))
            })
            .collect();
        let cells: Vec<Cell> = grid.cells().collect();
        let is_goal = |node: u32| {
            cells
                .get(node as usize)
                .is_some_and(|cell| goals.contains(cell))
        };
        let path = path_to(
            &Arcs::new(cells.len(), &arcs),
            grid.index(start) as u32,
            is_goal,
        );
        Ok(path.map(|path| {
            let cells = path.into_iter().filter_map(|node| cells.get(node as usize));
            cells.copied().map(tuple).collect()
        }))
    }

    /// Returns the openings as an undirected graph of networkx, whose nodes are cells.
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     If networkx is not installed.
    fn to_networkx<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let graph = py.import("networkx")?.call_method0("Graph")?;
        for cell in self.maze().grid().cells() {
            graph.call_method1("add_node", (tuple(cell),))?;
            for (_, next) in self.maze().neighbours(cell) {
                graph.call_method1("add_edge", (tuple(cell), tuple(next)))?;
            }
        }
        Ok(graph)
    }

    /// Returns the walls as an array of shape (2 height + 1, 2 width + 1), the north in the first
    /// row: 1 for a wall or a post, 0 where it is open. The cell (x, y) is at row
    /// 2 (height − y) − 1, column 2 x + 1.
    fn to_array<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u8>> {
        PyArray2::from_owned_array(py, walls(self.maze()))
    }

    /// Returns a drawing as SVG: walls, S at the start and G at the goals.
    fn svg(&self) -> String {
        let maze = self.maze();
        let grid = maze.grid();
        let side = 24;
        let (width, height) = (
            u32::from(grid.width()) * side,
            u32::from(grid.height()) * side,
        );
        let corner = |cell: Cell| (u32::from(cell.x) * side, height - u32::from(cell.y) * side);
        let mut walls = String::new();
        let mut marks = String::new();
        for cell in grid.cells() {
            let (west, south) = corner(cell);
            let (east, north) = (west + side, south - side);
            // Each inner wall once, and the border.
            for (direction, from, to) in [
                (Direction::North, (west, north), (east, north)),
                (Direction::East, (east, south), (east, north)),
                (Direction::South, (west, south), (east, south)),
                (Direction::West, (west, south), (west, north)),
            ] {
                let is_twice = matches!(direction, Direction::South | Direction::West);
                let is_drawn = !is_twice || maze.beside(cell, direction).is_none();
                if is_drawn && !maze.is_open(cell, direction) {
                    walls.push_str(&format!("M{} {}L{} {}", from.0, from.1, to.0, to.1));
                }
            }
            let is_start = maze.start().is_some_and(|(start, _)| start == cell);
            let letter = match (is_start, maze.goals().contains(&cell)) {
                (true, _) => "S",
                (false, true) => "G",
                (false, false) => continue,
            };
            let (x, y) = (west + side / 2, south - side / 3);
            marks.push_str(&format!(
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{letter}</text>"
            ));
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"-2 -2 {} {}\" \
             font-family=\"sans-serif\" font-size=\"14\"><path d=\"{walls}\" stroke=\"#222\" stroke-width=\"2\" \
             fill=\"none\"/>{marks}</svg>",
            width + 4,
            height + 4,
            width + 4,
            height + 4
        )
    }

    /// Draws the walls with matplotlib. A cell is a unit wide, and the south-west corner lies at
    /// the origin.
    ///
    /// Parameters
    /// ----------
    /// ax : matplotlib.axes.Axes or None
    ///     Where to draw; None makes new axes.
    ///
    /// Returns
    /// -------
    /// matplotlib.axes.Axes
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     If matplotlib is not installed.
    #[pyo3(signature = (ax = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        ax: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        pictures(slf.py())?.call_method1("plot_maze", (ax, slf))
    }

    /// Returns what a notebook shows.
    fn _repr_html_(&self) -> String {
        self.svg()
    }

    /// Writes the maze in the project's format, as the command reads it.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file, which is overwritten.
    ///
    /// Raises
    /// ------
    /// OSError
    ///     If it cannot be written.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn save(&self, path: PathBuf) -> PyResult<()> {
        let text = self.text()?;
        std::fs::write(&path, text).map_err(|error| unread(&path.display().to_string(), &error))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other
            .cast::<Self>()
            .is_ok_and(|other| other.get().file == self.file)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.maze().to_string().hash(&mut hasher);
        hasher.finish()
    }

    fn __str__(&self) -> String {
        self.maze().to_string()
    }

    fn __repr__(&self) -> String {
        format!(
            "<tolman.Maze {:?}, {} x {}>",
            self.name,
            self.width(),
            self.height()
        )
    }

    /// Returns the arguments that make a copy, for `pickle`.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((slf.get_type().into_any(), (slf.get().text()?,)))
    }
}

impl PyMaze {
    pub(crate) const fn maze(&self) -> &Maze {
        &self.file.maze
    }

    /// Returns the maze in the project's format.
    fn text(&self) -> PyResult<String> {
        let text = tolman_maze::write(&self.file, Format::Tolman);
        text.map_err(|error| refused("maze", &error))
    }

    /// Returns a cell of the maze.
    ///
    /// # Errors
    /// A `ValueError` that names the parameter, if the maze has no such cell.
    fn cell(&self, parameter: &str, (x, y): CellTuple) -> PyResult<Cell> {
        let grid = self.maze().grid();
        match x < grid.width() && y < grid.height() {
            true => Ok(Cell::new(x, y)),
            false => Err(wrong(format!(
                "{parameter} is ({x}, {y}), which lies outside of {} x {} cells",
                grid.width(),
                grid.height()
            ))),
        }
    }
}

/// Returns the family of this name.
///
/// # Errors
/// A `ValueError` that names the parameter, if there is none.
pub(crate) fn family(parameter: &str, name: &str) -> PyResult<Family> {
    let found = Family::named(&Family::ARENA, name);
    found.copied().ok_or_else(|| {
        let names = Family::ARENA.map(|family| family.name);
        wrong(format!(
            "{parameter} is '{name}' but has to be one of {}",
            names.join(", ")
        ))
    })
}

/// Returns the direction of this name.
///
/// # Errors
/// A `ValueError` that names the parameter, if there is none.
pub(crate) fn direction(parameter: &str, name: &str) -> PyResult<Direction> {
    let mut known = Direction::ALL.into_iter();
    known
        .find(|known| known.to_string() == name)
        .ok_or_else(|| {
            wrong(format!(
                "{parameter} is '{name}' but has to be 'north', 'east', 'south' or 'west'"
            ))
        })
}

/// Returns the walls as [`PyMaze::to_array`] does.
pub(crate) fn walls(maze: &Maze) -> Array2<u8> {
    let grid = maze.grid();
    let (width, height) = (usize::from(grid.width()), usize::from(grid.height()));
    let mut walls = Array2::<u8>::ones((2 * height + 1, 2 * width + 1));
    for cell in grid.cells() {
        let middle = place(grid, cell);
        walls[middle] = 0;
        for direction in Direction::ALL {
            if maze.is_open(cell, direction) {
                walls[ahead(middle, direction)] = 0;
            }
        }
    }
    walls
}

/// Returns the row and column of a cell in an array of walls.
fn place(grid: Grid, cell: Cell) -> [usize; 2] {
    let row = 2 * usize::from(grid.height() - cell.y) - 1;
    [row, 2 * usize::from(cell.x) + 1]
}

/// Returns the place of the wall beside a cell.
const fn ahead([row, column]: [usize; 2], direction: Direction) -> [usize; 2] {
    match direction {
        Direction::North => [row - 1, column],
        Direction::East => [row, column + 1],
        Direction::South => [row + 1, column],
        Direction::West => [row, column - 1],
    }
}

/// Returns the maze of an array of walls.
///
/// # Errors
/// A `ValueError` that says how the array has to be.
fn of_array(source: &Bound<'_, PyAny>) -> PyResult<Maze> {
    let py = source.py();
    let how = "source has to be a text of several lines, a path, or an array of 0 and 1";
    let array = py.import("numpy")?.call_method1("asarray", (source,));
    let array = array.and_then(|array| array.call_method1("astype", ("float64",)));
    let array = array.map_err(|_| wrong(format!("{how}, not {}", kind(source))))?;
    let array = array.extract::<PyReadonlyArray2<'_, f64>>();
    let array = array.map_err(|_| wrong(format!("{how} with two dimensions")))?;
    let walls = array.as_array();
    let (rows, columns) = walls.dim();
    let longest = 2 * usize::from(u8::MAX) + 1;
    if rows % 2 == 0 || columns % 2 == 0 || rows < 3 || columns < 3 || rows.max(columns) > longest {
        return Err(wrong(format!(
            "source has the shape ({rows}, {columns}), but an array of walls has the shape (2 height + 1, 2 width + 1), \
             up to {longest}: cells, and walls between them"
        )));
    }
    if let Some(((row, column), value)) = walls
        .indexed_iter()
        .find(|(_, value)| ![0.0, 1.0].contains(*value))
    {
        return Err(wrong(format!(
            "source has {value} at row {row}, column {column}, but 1 is a wall and 0 is open"
        )));
    }
    let grid = Grid::new((columns / 2) as u16, (rows / 2) as u16);
    let mut maze = Maze::open(grid);
    for cell in grid.cells() {
        let middle = place(grid, cell);
        if walls[middle] > 0.5 {
            let [row, column] = middle;
            return Err(wrong(format!(
                "source has a wall at row {row}, column {column}, the middle of a cell: cells are at odd rows and columns"
            )));
        }
        for direction in Direction::ALL {
            let [row, column] = ahead(middle, direction);
            let stands = walls[[row, column]] > 0.5;
            if maze.beside(cell, direction).is_none() && !stands {
                return Err(wrong(format!(
                    "source is open at row {row}, column {column}, but the border has to be closed"
                )));
            }
            maze.set_wall(cell, direction, stands);
        }
    }
    Ok(maze)
}

/// Returns the name of a value's type.
fn kind(value: &Bound<'_, PyAny>) -> String {
    let name = value.get_type().name();
    name.map_or_else(|_| "this".to_owned(), |name| name.to_string())
}

const fn tuple(cell: Cell) -> CellTuple {
    (cell.x, cell.y)
}

/// Returns the path of a file as its name, and the file's text.
fn of_file(path: &PathBuf) -> PyResult<(String, String)> {
    let name = path.display().to_string();
    match std::fs::read_to_string(path) {
        Ok(text) => Ok((name, text)),
        Err(error) => Err(unread(&name, &error)),
    }
}
