//! A maze made ready for runs: its world, its corridors, and where runs may begin.

use alloc::sync::Arc;
use core::f64::consts::PI;

use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::{Cell, Maze, MazeFile};
use tolman_robot::Body;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{CorridorSize, World, WorldError, Zone};

use crate::episode::EpisodeError;
use crate::pioneer::{CORRIDOR_WIDTH, CoursePioneer};
use crate::{Landmarks, Simulated};

/// Why no robot can run in a maze.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CourseError {
    /// The maze marks no destination.
    #[error("the maze marks no destination: mark its cells with G")]
    NoDestination,
    /// The corridors are too narrow for the robot.
    #[error(
        "a robot {diameter} m across does not fit corridors {width} m wide: widen them with `corridor_width` in the maze file's header"
    )]
    TooNarrow {
        /// The robot's diameter, m.
        diameter: f64,
        /// The corridors' width, m.
        width: f64,
    },
    /// There is no cell to start from: every cell that can reach the destination is part of it.
    #[error("no cell outside the destination can reach it: open a way to it")]
    NoStart,
    /// The world cannot be built.
    #[error("the maze makes no world")]
    World(#[from] WorldError),
}

/// A maze as a world with corridors of one width, a destination, and places to start from.
#[derive(Clone, Debug)]
pub struct Course {
    /// The maze, or the file's, name.
    pub name: String,
    /// The maze it was built from.
    pub maze: Maze,
    /// Its walls and zones.
    pub world: Arc<World>,
    /// From wall to wall, m.
    pub corridor_width: f64,
    starts: Vec<Cell>,
    /// By cell index: whether a way leads from there to the destination.
    leads_on: Vec<bool>,
    destination: Zone,
}

/// MSLST gives a robot 500 time steps in its Large maze, which has 63 cells to start from here, each
/// [`CORRIDOR_WIDTH`] wide.
const STEPS_PER_METRE: f64 = 500.0 / (63.0 * CORRIDOR_WIDTH);

/// No course is so short that a robot need not turn round in it, time steps.
const LEAST_STEPS: u32 = 100;

impl Course {
    /// Makes the course of a maze file for a robot of this `body`. The file's corridor width counts,
    /// or else MSLST's 1.9 robot units.
    ///
    /// # Errors
    /// [`CourseError`] if the maze has no destination or none that can be reached, or the robot does
    /// not fit.
    pub fn new(name: &str, file: &MazeFile, body: &Body) -> Result<Self, CourseError> {
        let corridor_width = file.corridor_width.unwrap_or(CORRIDOR_WIDTH);
        let diameter = 2.0 * body.radius();
        if corridor_width <= diameter {
            return Err(CourseError::TooNarrow {
                diameter,
                width: corridor_width,
            });
        }
        let maze = file.maze.clone();
        let steps = maze.steps_to_goal();
        let starts: Vec<Cell> = maze
            .grid()
            .cells()
            .filter(|cell| steps[maze.grid().index(*cell)].is_some_and(|steps| steps > 0))
            .collect();
        let world = World::from_maze(&maze, &CorridorSize::thin(corridor_width))?;
        let destination = world
            .zone("destination")
            .cloned()
            .ok_or(CourseError::NoDestination)?;
        if starts.is_empty() {
            return Err(CourseError::NoStart);
        }
        Ok(Self {
            name: name.to_owned(),
            maze,
            world: Arc::new(world),
            corridor_width,
            starts,
            leads_on: steps.iter().map(Option::is_some).collect(),
            destination,
        })
    }

    /// Time steps after which a run has failed where nothing else is said: in proportion to the length
    /// of the corridors, as many for each metre as MSLST gives in its Large maze.
    #[must_use]
    pub fn step_limit(&self) -> u32 {
        let metres = self.starts.len() as f64 * self.corridor_width;
        (libm::ceil(STEPS_PER_METRE * metres - 1e-9) as u32).max(LEAST_STEPS)
    }

    /// Whether a way leads from a position to the destination: whether it lies in a cell that is not
    /// walled off from it.
    #[must_use]
    pub fn leads_on(&self, position: Point) -> bool {
        let cell = self.world.cell_at(position);
        cell.is_some_and(|cell| self.leads_on[self.maze.grid().index(cell)])
    }

    /// Where the robot is to go.
    #[must_use]
    pub const fn destination(&self) -> &Zone {
        &self.destination
    }

    /// The cells a run may start from: those outside the destination that can reach it.
    #[must_use]
    pub fn starts(&self) -> &[Cell] {
        &self.starts
    }

    /// Returns a robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If the robot cannot be built or cannot stand there.
    pub fn robot_at(
        &self,
        start: Pose,
        robot: &LaserPioneerConfig,
        seed: u64,
    ) -> Result<CoursePioneer, EpisodeError> {
        let model = LaserPioneer::new(robot.clone())?;
        let landmarks = Landmarks::goal(self.destination.clone());
        let world = Arc::clone(&self.world);
        Ok(Simulated::new(world, landmarks, model, start, seed)?)
    }

    /// A random start: any of those cells with equal chance, any place in its middle from which the
    /// body would stand clear of walls on all four sides, any heading.
    pub fn random_start(&self, body: &Body, rng: &mut impl Rng) -> Pose {
        let cell = self.starts[rng.random_range(0..self.starts.len() as u32) as usize];
        let play = (0.5 * self.corridor_width - body.radius()).max(0.0) * 0.99;
        let offset = Vector::new(
            rng.random_range(-play..=play),
            rng.random_range(-play..=play),
        );
        let heading = Heading::from_radians(rng.random_range(-PI..PI));
        Pose::new(self.world.cell_centre(cell) + offset, heading)
    }
}
