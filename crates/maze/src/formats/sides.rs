//! Reads mazes given cell by cell. Each wall is given twice, and the two must agree.

use super::{CLASSIC_START, MazeError, MazeFault, Parsed, Place};
use crate::{Cell, CheckError, Direction, Grid, Maze};

/// Sides of one cell in a text.
#[derive(Clone, Copy)]
pub(super) struct Sides {
    /// Bit `1 << direction.index()` is set where the cell is open.
    pub(super) open: u8,
    pub(super) place: Place,
}

impl Sides {
    pub(super) const fn is_open(self, direction: Direction) -> bool {
        self.open >> direction.index() & 1 == 1
    }
}

/// Returns the bits of [`Sides::open`] of a cell of `maze`.
pub(super) fn open_sides(maze: &Maze, cell: Cell) -> u8 {
    let bit = |direction: Direction| u8::from(maze.is_open(cell, direction)) << direction.index();
    Direction::ALL.into_iter().map(bit).sum()
}

/// Returns the maze whose cells have the sides `sides`, by [`Grid::index`]. Start and goals are
/// those of classic competitions.
pub(super) fn parsed(grid: Grid, sides: &[Sides]) -> Result<Parsed, MazeError> {
    let mut maze = maze(grid, sides)?;
    maze.set_start(Some(CLASSIC_START));
    maze.set_goals(grid.middle().collect());
    let places = sides.iter().map(|sides| sides.place).collect();
    Ok(Parsed::new(maze, places))
}

fn maze(grid: Grid, sides: &[Sides]) -> Result<Maze, MazeError> {
    let mut maze = Maze::open(grid);
    for (cell, here) in grid.cells().zip(sides) {
        for direction in Direction::ALL {
            let open = here.is_open(direction);
            match grid.neighbour(cell, direction) {
                Some(neighbour) => {
                    let there = sides.get(grid.index(neighbour));
                    if there.is_none_or(|there| there.is_open(direction.opposite()) != open) {
                        let fault = MazeFault::Disagree {
                            cell,
                            direction,
                            open,
                            neighbour,
                        };
                        return Err(here.place.fault(fault));
                    }
                    maze.set_wall(cell, direction, !open);
                }
                None if open => {
                    let fault = MazeFault::Maze(CheckError::OpenBorder { cell, direction });
                    return Err(here.place.fault(fault));
                }
                None => {}
            }
        }
    }
    Ok(maze)
}
