use alloc::vec::Vec;

use rand::Rng;

use super::super::{GenerateError, chance, grid};
use crate::{Cell, Direction, Grid, Maze};

/// Draws corridors into a maze in which every wall stands.
pub(super) struct Pen {
    maze: Maze,
}

impl Pen {
    /// Returns a pen for a maze of this size.
    ///
    /// # Errors
    /// [`GenerateError::Small`] if it has not at least `least` columns and rows,
    /// [`GenerateError::Size`] if it is too large.
    pub(super) fn new(
        drawing: &'static str,
        (width, height): (u16, u16),
        least: (u16, u16),
    ) -> Result<Self, GenerateError> {
        if width < least.0 || height < least.1 {
            return Err(GenerateError::Small {
                drawing,
                width,
                height,
                least,
            });
        }
        let maze = Maze::solid(grid(width, height)?);
        Ok(Self { maze })
    }

    pub(super) const fn grid(&self) -> Grid {
        self.maze.grid()
    }

    pub(super) const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Opens or closes the wall on one side of a cell; the border stays closed.
    pub(super) fn set(&mut self, cell: Cell, direction: Direction, stands: bool) {
        if self.grid().neighbour(cell, direction).is_some() {
            self.maze.set_wall(cell, direction, stands);
        }
    }

    /// Draws a corridor of `cells` cells onward from `from`, and returns its last cell. The
    /// corridor ends earlier at the border.
    pub(super) fn line(&mut self, from: Cell, direction: Direction, cells: u16) -> Cell {
        let mut at = from;
        for _ in 0..cells {
            let Some(next) = self.grid().neighbour(at, direction) else {
                break;
            };
            self.maze.set_wall(at, direction, false);
            at = next;
        }
        at
    }

    /// Draws the outline of a rectangle from its south-west `corner`, `width` cells to the east and
    /// `height` cells to the north.
    pub(super) fn rectangle(&mut self, corner: Cell, width: u16, height: u16) {
        let east = self.line(corner, Direction::East, width);
        self.line(corner, Direction::North, height);
        self.line(east, Direction::North, height);
        self.line(
            Cell::new(corner.x, corner.y + height),
            Direction::East,
            width,
        );
    }

    /// Returns the cells that are drawn, in the order of [`Grid::index`].
    pub(super) fn drawn(&self) -> Vec<Cell> {
        let cells = self.grid().cells();
        cells.filter(|cell| self.maze.degree(*cell) > 0).collect()
    }

    /// Returns the maze with this start, looking through its first opening. The goal is the drawn
    /// cell farthest from it, a random one if there are several.
    pub(super) fn finish(mut self, start: Cell, rng: &mut impl Rng) -> Maze {
        let steps = self.maze.steps_to(&[start]);
        let drawn = self.drawn();
        let far = |cell: &Cell| steps[self.grid().index(*cell)];
        let most = drawn.iter().filter_map(far).max();
        let farthest: Vec<Cell> = drawn.iter().copied().filter(|c| far(c) == most).collect();
        let goal = farthest.get(chance::position(farthest.len().max(1), rng));
        let first = self.maze.neighbours(start).next();
        let heading = first.map_or(Direction::North, |(heading, _)| heading);
        self.maze.set_start(Some((start, heading)));
        self.maze.set_goals(goal.copied().into_iter().collect());
        self.maze
    }

    /// Ends like [`finish`](Self::finish), with any drawn cell as start.
    pub(super) fn finish_anywhere(self, rng: &mut impl Rng) -> Maze {
        let drawn = self.drawn();
        let start = drawn.get(chance::position(drawn.len().max(1), rng));
        let start = start.copied().unwrap_or(Cell::new(0, 0));
        self.finish(start, rng)
    }
}
