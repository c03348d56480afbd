use pyo3::prelude::*;
use tolman_maze::{Cell, Grid};
use tolman_systems::micromouse::{
    Brief, Driver, Movement, Order, Rotation, RunTwo, SIDE, Sight, WholeMaze,
};

use crate::errors::{refused, wrong};
use crate::maze::{CellTuple, direction};

/// A micromouse that visits every cell of a maze, of which it knows the size.
///
/// Parameters
/// ----------
/// width, height : int
///     Number of columns and rows, from 1 to 32.
/// start : (int, int)
///     Column from the west and row from the south, from 0.
/// heading : {"north", "east", "south", "west"}
///     Where the mouse looks.
///
/// Raises
/// ------
/// ValueError
///     If there is no such size, cell or direction.
#[pyclass(name = "Mouse", module = "tolman")]
pub(crate) struct PyMouse {
    driver: Driver<WholeMaze>,
    is_done: bool,
}

#[pymethods]
impl PyMouse {
    /// Puts a mouse into a maze of `width` by `height` cells, where it looks to `heading`, such as
    /// `"north"`.
    #[new]
    #[pyo3(
        signature = (width, height, start = (0, 0), heading = "north"),
        text_signature = "(width, height, start=(0, 0), heading='north')"
    )]
    fn new(width: u16, height: u16, start: CellTuple, heading: &str) -> PyResult<Self> {
        for (name, value) in [("width", width), ("height", height)] {
            if !(1..=SIDE).contains(&usize::from(value)) {
                return Err(wrong(format!(
                    "{name} is {value} but has to be from 1 to {SIDE}"
                )));
            }
        }
        let (grid, cell) = (Grid::new(width, height), Cell::new(start.0, start.1));
        if !grid.contains(cell) {
            return Err(wrong(format!(
                "start is ({}, {}), which lies outside of {width} x {height} cells",
                cell.x, cell.y
            )));
        }
        let brief = Brief {
            grid,
            start: cell,
            heading: direction("heading", heading)?,
            // Its search ends where nothing is left to visit, wherever a run would end.
            goals: vec![cell],
        };
        let driver = Driver::new(brief, WholeMaze, RunTwo::FewestMoves);
        Ok(Self {
            driver: driver.map_err(|error| refused("width", &error))?,
            is_done: false,
        })
    }

    /// Takes what the mouse sees, and returns what to do.
    ///
    /// Parameters
    /// ----------
    /// left, ahead, right : int
    ///     Number of open cells to that side.
    ///
    /// Returns
    /// -------
    /// (int, int) or None
    ///     Degrees to turn clockwise, then cells to drive ahead, or back if negative. `None` if it
    ///     has visited every cell that can be reached.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the walls that it sees contradict those that it saw before.
    fn next(&mut self, left: u16, ahead: u16, right: u16) -> PyResult<Option<(i32, i32)>> {
        if self.is_done {
            return Ok(None);
        }
        let front = ahead;
        let order = self.driver.next(Sight { left, front, right });
        match order.map_err(|error| refused("left, ahead, right", &error))? {
            Order {
                rotation: Rotation::Degrees(degrees),
                movement: Movement::Cells(cells),
            } => Ok(Some((degrees, cells))),
            _ => {
                self.is_done = true;
                Ok(None)
            }
        }
    }
}
