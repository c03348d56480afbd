//! Where the e-puck runs.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze, MazeFile};
use tolman_sim::World;

use super::robots::epuck;
use super::trial::{TrialError, start_of, world_of};

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

    /// The narrowest and the widest corridors, m, in which Mazes 1 to 3 are learned rightly: in others the robot takes bends for junctions and
    /// overlooks others.
    pub const WIDTHS: (f64, f64) = (0.20, 0.30);

    /// That of a maze file; `name` is for one that has none.
    ///
    /// # Errors
    /// [`TrialError::NoStart`], [`TrialError::Width`].
    pub fn new(name: &str, file: MazeFile) -> Result<Self, TrialError> {
        if file.maze.start().is_none() {
            return Err(TrialError::NoStart);
        }
        let width = file.corridor_width.unwrap_or(Self::CORRIDOR_WIDTH);
        let (least, most) = Self::WIDTHS;
        if !(least..=most).contains(&width) {
            return Err(TrialError::Width {
                width,
                least,
                most,
                reach: epuck().response.reach(),
            });
        }
        Ok(Self {
            name: file.name.unwrap_or_else(|| name.to_owned()),
            maze: file.maze,
            corridor_width: width,
        })
    }

    /// The first of four cells without a wall between them, if there are any: in rooms the robot, which follows corridors, may go round for ever
    /// and take one way out for another.
    #[must_use]
    pub fn room(&self) -> Option<Cell> {
        let mut cells = self.maze.grid().cells();
        cells.find(|cell| self.maze.is_room(*cell))
    }

    /// In the middle of the cell that the maze marks as its start, looking as it says.
    ///
    /// # Errors
    /// [`TrialError::NoStart`].
    pub fn start(&self, world: &World) -> Result<Pose, TrialError> {
        start_of(&self.maze, world)
    }

    /// In the middle of any cell from which the goal can be reached, looking along a way out of it; none if there are none.
    #[must_use]
    pub fn anywhere(&self, world: &World, seed: u64) -> Option<Pose> {
        let out_of = |cell| {
            let neighbours = self.maze.neighbours(cell);
            neighbours.map(move |(direction, _)| (cell, direction))
        };
        let ways: Vec<(Cell, Direction)> = self.maze.reachable().flat_map(out_of).collect();
        if ways.is_empty() {
            return None;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let (cell, direction) = ways[rng.random_range(0..ways.len() as u32) as usize];
        Some(Pose::new(world.cell_centre(cell), heading_of(direction)))
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
