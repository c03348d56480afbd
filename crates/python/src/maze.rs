use std::path::PathBuf;

use pyo3::prelude::*;
use rand_chacha::ChaCha8Rng;
use tolman_arena::family::Family;
use tolman_maze::rand::SeedableRng;
use tolman_maze::{Cell, Direction, Format, Maze, MazeFile};
use tolman_planners::{Arcs, path_to};

use crate::errors::{reasons, refused, unread, wrong};

/// A cell as Python writes it: column from the west, row from the south.
pub(crate) type CellTuple = (u16, u16);

/// A maze of square cells.
#[pyclass(name = "Maze", module = "tolman", frozen)]
pub(crate) struct PyMaze {
    pub(crate) name: String,
    pub(crate) file: MazeFile,
}

/// The source of a maze.
#[derive(FromPyObject)]
enum Source {
    Text(String),
    Path(PathBuf),
}

#[pymethods]
impl PyMaze {
    /// Reads a maze in any format that `tolman maze check` accepts. `source` is a text of several
    /// lines or the path of a file.
    #[new]
    fn new(source: Source) -> PyResult<Self> {
        let (name, text) = match source {
            Source::Text(text) if text.trim_end().contains('\n') => ("maze".to_owned(), text),
            Source::Text(path) => of_file(&PathBuf::from(path))?,
            Source::Path(path) => of_file(&path)?,
        };
        let file = tolman_maze::read(&text).map_err(|error| refused(&name, &error))?;
        let name = file.name.clone().unwrap_or(name);
        Ok(Self { name, file })
    }

    /// Generates a maze of a family, such as `perfect`, `braided` or `office`. The same `seed`
    /// gives the same maze.
    #[staticmethod]
    #[pyo3(signature = (family = "perfect", width = 8, height = 8, *, seed = 1))]
    fn generate(family: &str, width: u16, height: u16, seed: u64) -> PyResult<Self> {
        let Some(found) = Family::named(&Family::ARENA, family) else {
            let names = Family::ARENA.map(|family| family.name);
            return Err(wrong(format!(
                "family is '{family}' but has to be one of {}",
                names.join(", ")
            )));
        };
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

    /// Returns whether there is no wall between `cell` and its neighbour in a direction: `"north"`,
    /// `"east"`, `"south"` or `"west"`.
    fn is_open(&self, cell: CellTuple, direction: &str) -> PyResult<bool> {
        let cell = self.cell("cell", cell)?;
        Ok(self
            .maze()
            .is_open(cell, self::direction("direction", direction)?))
    }

    /// Returns the neighbours of `cell` without a wall in between.
    fn neighbours(&self, cell: CellTuple) -> PyResult<Vec<CellTuple>> {
        let cell = self.cell("cell", cell)?;
        Ok(self
            .maze()
            .neighbours(cell)
            .map(|(_, next)| tuple(next))
            .collect())
    }

    /// Returns the cells of a shortest path, including both ends, or `None` if no path exists. By
    /// default it leads from the marked start to a marked goal.
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
        let text = tolman_maze::write(&slf.get().file, Format::Tolman);
        let text = text.map_err(|error| refused("maze", &error))?;
        Ok((slf.get_type().into_any(), (text,)))
    }
}

impl PyMaze {
    pub(crate) const fn maze(&self) -> &Maze {
        &self.file.maze
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
