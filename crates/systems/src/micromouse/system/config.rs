use thiserror::Error;
use tolman_geom::{OutOfRange, POSITIVE, Point};
use tolman_maze::Cell;

use super::super::MouseError;

/// Knowledge of a [`MazeMouse`](super::MazeMouse) about the maze and its own drive.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MazeMouseConfig {
    /// Distance between the middles of neighbouring cells, m. > 0.
    pub pitch: f64,
    /// Thickness of a wall, m. ≥ 0, below half of the pitch.
    pub wall_thickness: f64,
    /// Turn made in a time step at the full command, rad. > 0.
    pub turn_per_step: f64,
    /// Distance covered in a time step at the full command, m. > 0.
    pub translate_per_step: f64,
}

/// Reason why a mouse cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MazeMouseError {
    /// A number of the configuration is out of its range.
    #[error(transparent)]
    Field(#[from] OutOfRange),
    /// The mouse cannot hold the maze or search in it.
    #[error(transparent)]
    Mouse(#[from] MouseError),
}

impl MazeMouseConfig {
    /// Returns the configuration for cells `pitch` m apart between walls without thickness.
    #[must_use]
    pub const fn new(pitch: f64, turn_per_step: f64, translate_per_step: f64) -> Self {
        Self {
            pitch,
            wall_thickness: 0.0,
            turn_per_step,
            translate_per_step,
        }
    }

    /// Returns the middle of a cell, in the frame of the maze.
    #[must_use]
    pub fn middle(&self, cell: Cell) -> Point {
        let along = |index: u16| (f64::from(index) + 0.5) * self.pitch;
        Point::new(along(cell.x), along(cell.y))
    }

    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::check("pitch", self.pitch, POSITIVE)?;
        OutOfRange::check("wall_thickness", self.wall_thickness, 0.0..0.5 * self.pitch)?;
        OutOfRange::check("turn_per_step", self.turn_per_step, POSITIVE)?;
        OutOfRange::check("translate_per_step", self.translate_per_step, POSITIVE)
    }
}
