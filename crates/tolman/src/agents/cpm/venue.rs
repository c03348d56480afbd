//! Where the e-puck runs.

use tolman_maze::{Maze, MazeFile};
use tolman_sim::World;

use super::trial::{TrialError, world_of};

/// A maze with a start, and how wide its corridors are for an e-puck.
#[derive(Clone, Debug)]
pub struct Venue {
    /// Its name.
    pub name: String,
    /// Its walls, start and goals.
    pub maze: Maze,
    /// From wall to wall, m.
    pub corridor_width: f64,
}

impl Venue {
    /// Where nothing else is said, m.
    pub const CORRIDOR_WIDTH: f64 = 0.25;

    /// That of a maze file; `name` is for one that has none.
    ///
    /// # Errors
    /// [`TrialError::NoStart`].
    pub fn new(name: &str, file: MazeFile) -> Result<Self, TrialError> {
        if file.maze.start().is_none() {
            return Err(TrialError::NoStart);
        }
        Ok(Self {
            name: file.name.unwrap_or_else(|| name.to_owned()),
            maze: file.maze,
            corridor_width: file.corridor_width.unwrap_or(Self::CORRIDOR_WIDTH),
        })
    }

    /// Its thin walls.
    ///
    /// # Errors
    /// [`TrialError::World`] where the corridors have no width.
    pub fn world(&self) -> Result<World, TrialError> {
        world_of(&self.maze, self.corridor_width)
    }

    /// The length of the shortest way from start to goal, m; none if there is none.
    #[must_use]
    pub fn shortest_metres(&self) -> Option<f64> {
        let (start, _) = self.maze.start()?;
        let steps = self.maze.steps_to_goal()[self.maze.grid().index(start)]?;
        Some(f64::from(steps) * self.corridor_width)
    }
}
