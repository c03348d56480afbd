//! Where the e-puck runs.

use alloc::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze, MazeFile};
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_sim::{CorridorSize, World};

use super::robots::{SimulatedEpuck, epuck};
use super::trial::TrialError;
use crate::Landmarks;

/// A maze with a start, and how wide its corridors are for an e-puck.
#[derive(Clone, Debug)]
pub struct Venue {
    /// Its name.
    pub name: String,
    /// Its walls, start and goals.
    pub maze: Maze,
    /// From wall to wall, m.
    pub corridor_width: f64,
    /// Its thin walls.
    pub world: Arc<World>,
}

impl Venue {
    /// Where nothing else is said, m.
    pub const CORRIDOR_WIDTH: f64 = 0.25;

    /// The narrowest and the widest corridors, m, in which Mazes 1 to 3 are learned rightly: in others the robot takes bends for junctions and
    /// overlooks others.
    pub const WIDTHS: (f64, f64) = (0.20, 0.30);

    /// A maze of thin walls.
    ///
    /// # Errors
    /// [`TrialError::World`] where the corridors have no width.
    pub fn new(name: &str, maze: Maze, corridor_width: f64) -> Result<Self, TrialError> {
        let world = World::from_maze(&maze, &CorridorSize::thin(corridor_width))?;
        Ok(Self {
            name: name.to_owned(),
            maze,
            corridor_width,
            world: Arc::new(world),
        })
    }

    /// That of a maze file; `name` is for one that has none.
    ///
    /// # Errors
    /// [`TrialError::NoStart`], [`TrialError::Width`].
    pub fn of_file(name: &str, file: MazeFile) -> Result<Self, TrialError> {
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
        Self::new(file.name.as_deref().unwrap_or(name), file.maze, width)
    }

    /// The robot at the start.
    ///
    /// # Errors
    /// If the maze has no start, or the robot cannot stand there.
    pub fn robot(&self, robot: EpuckConfig, seed: u64) -> Result<SimulatedEpuck, TrialError> {
        self.robot_at(self.start()?, robot, seed)
    }

    /// The robot anywhere.
    ///
    /// # Errors
    /// If the robot cannot be built or cannot stand there.
    pub fn robot_at(
        &self,
        start: Pose,
        robot: EpuckConfig,
        seed: u64,
    ) -> Result<SimulatedEpuck, TrialError> {
        let (world, robot) = (Arc::clone(&self.world), Epuck::new(robot)?);
        let landmarks = Landmarks::of(&world);
        Ok(SimulatedEpuck::new(world, landmarks, robot, start, seed)?)
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
    pub fn start(&self) -> Result<Pose, TrialError> {
        let (cell, direction) = self.maze.start().ok_or(TrialError::NoStart)?;
        Ok(self.in_cell(cell, direction))
    }

    /// In the middle of a cell, looking in a direction.
    #[must_use]
    pub fn in_cell(&self, cell: Cell, direction: Direction) -> Pose {
        Pose::new(self.world.cell_centre(cell), heading_of(direction))
    }

    /// In the middle of any cell from which the goal can be reached, looking along a way out of it; none if there are none.
    #[must_use]
    pub fn anywhere(&self, seed: u64) -> Option<Pose> {
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
        Some(self.in_cell(cell, direction))
    }

    /// The length of the shortest way from start to goal, m; none if there is none.
    #[must_use]
    pub fn shortest_metres(&self) -> Option<f64> {
        let (start, _) = self.maze.start()?;
        let steps = self.maze.steps_to_goal()[self.maze.grid().index(start)]?;
        Some(f64::from(steps) * self.corridor_width)
    }
}
