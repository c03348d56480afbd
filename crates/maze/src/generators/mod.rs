//! Seeded mazes. Those of whole grids share one way to mark start and goal.

mod braided;
mod chance;
pub mod drawings;
mod error;
mod hook;
mod one_loop;
mod perfect;
mod rooms;

pub use braided::Braided;
pub use error::GenerateError;
pub use hook::Hook;
pub use one_loop::OneLoop;
pub use perfect::Perfect;
pub use rooms::Rooms;

use alloc::vec::Vec;

use crate::{Cell, Direction, Grid, Maze};

/// Returns the grid of a size that mazes can be generated in.
fn grid(width: u16, height: u16) -> Result<Grid, GenerateError> {
    let grid = Grid::new(width, height);
    if grid.cell_count() < 2 || width.max(height) > Grid::MAX_SIDE {
        return Err(GenerateError::Size { width, height });
    }
    Ok(grid)
}

/// Marks start and goal where classic competitions have them. The start is the south-west cell,
/// looking through its first opening clockwise from north. The goal is the middle.
///
/// If the middle of a small maze holds the start, the run would be over before it began. Then the
/// goal is the cell farthest from the start, of several the last by [`Grid::index`].
fn mark(maze: &mut Maze) {
    let start = Cell::new(0, 0);
    let heading = maze
        .neighbours(start)
        .next()
        .map_or(Direction::North, |(heading, _)| heading);
    maze.set_start(Some((start, heading)));
    let mut goals: Vec<Cell> = maze.grid().middle().collect();
    if goals.contains(&start) {
        let steps = maze.steps_to(&[start]);
        let farthest = |cell: &Cell| steps[maze.grid().index(*cell)];
        goals = maze
            .grid()
            .cells()
            .max_by_key(farthest)
            .into_iter()
            .collect();
    }
    maze.set_goals(goals);
}

/// Opens a corridor of `cells` cells beyond `from` and returns its last cell. The corridor ends
/// earlier at the border.
fn carved(maze: &mut Maze, from: Cell, direction: Direction, cells: u16) -> Cell {
    let grid = maze.grid();
    let mut here = from;
    for _ in 0..cells {
        let Some(next) = grid.neighbour(here, direction) else {
            break;
        };
        maze.set_wall(here, direction, false);
        here = next;
    }
    here
}
