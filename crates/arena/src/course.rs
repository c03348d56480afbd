//! A maze made ready for runs: its world, its corridors, and where runs may begin.

use alloc::sync::Arc;
use core::f64::consts::PI;

use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_control::heading_of;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::{Cell, Direction, Maze, MazeFile};
use tolman_robot::Body;
use tolman_sim::{CorridorSize, Model, PlaceError, World, WorldError, Zone};
use tolman_systems::stream;

use crate::Simulated;
use crate::pioneer::CORRIDOR_WIDTH;

/// Why no robot can run in a maze.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CourseError {
    /// The maze marks no destination.
    #[error("the maze marks no destination: mark its cells with G")]
    NoDestination,
    /// The maze marks no start.
    #[error("the maze marks no start: mark a cell with S")]
    NoStart,
    /// There is no cell to start from: every cell that can reach the destination is part of it.
    #[error("no cell outside the destination can reach it: open a way to it")]
    CutOff,
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
    /// In such corridors an e-puck does not see what they are.
    #[error(
        "corridors of {width} m: an e-puck, whose sensors reach {reach} m, tells junctions in corridors of {least} to {most} m alone; set \
         corridor_width to 0.25"
    )]
    Unseen {
        /// From wall to wall, m.
        width: f64,
        /// How narrow they may be, m.
        least: f64,
        /// How wide they may be, m.
        most: f64,
        /// How far its sensors reach, m.
        reach: f64,
    },
    /// The world cannot be built.
    #[error("the maze makes no world")]
    World(#[from] WorldError),
}

/// A maze as a world with corridors of one width, a destination if the maze has one, and places to start from.
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
    /// By cell index: the number of cells to the destination; `None` where no way leads there.
    steps_to_goal: Vec<Option<u32>>,
}

/// MSLST gives a robot 500 time steps in its Large maze, which has 63 cells to start from here, each
/// [`CORRIDOR_WIDTH`] wide.
const STEPS_PER_METRE: f64 = 500.0 / (63.0 * CORRIDOR_WIDTH);

/// No course is so short that a robot need not turn round in it, time steps.
const LEAST_STEPS: u32 = 100;

impl Course {
    /// Returns a maze of thin walls with corridors of this width, m.
    ///
    /// # Errors
    /// [`CourseError::World`] if the corridors have no width.
    pub fn new(name: &str, maze: Maze, corridor_width: f64) -> Result<Self, CourseError> {
        let world = World::from_maze(&maze, &CorridorSize::thin(corridor_width))?;
        Ok(Self::in_world(name, maze, corridor_width, world))
    }

    /// Returns a maze whose walls stand in `world`, with corridors of this width, m.
    #[must_use]
    pub fn in_world(name: &str, maze: Maze, corridor_width: f64, world: World) -> Self {
        Self {
            name: name.to_owned(),
            steps_to_goal: maze.steps_to_goal(),
            maze,
            world: Arc::new(world),
            corridor_width,
        }
    }

    /// Returns a maze file as a course to its destination for a robot of this `body`. The file's corridor width counts,
    /// or else MSLST's 1.9 robot units.
    ///
    /// # Errors
    /// [`CourseError`] if the maze has no destination or none that can be reached, or the robot does
    /// not fit.
    pub fn for_body(name: &str, file: &MazeFile, body: &Body) -> Result<Self, CourseError> {
        let width = file.corridor_width.unwrap_or(CORRIDOR_WIDTH);
        let diameter = 2.0 * body.radius();
        if width <= diameter {
            return Err(CourseError::TooNarrow { diameter, width });
        }
        let course = Self::new(name, file.maze.clone(), width)?;
        course.destination().ok_or(CourseError::NoDestination)?;
        course.starts().next().ok_or(CourseError::CutOff)?;
        Ok(course)
    }

    /// Returns what tells this drawing from others of its name: a hash of walls, marks and the corridors' width.
    #[must_use]
    pub fn drawing(&self) -> String {
        let text = format!("{}{}", self.maze, self.corridor_width);
        // FNV-1a, 64 bits.
        let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        format!("{hash:016x}")
    }

    /// Time steps after which a run has failed where nothing else is said: in proportion to the length
    /// of the corridors, as many for each metre as MSLST gives in its Large maze.
    #[must_use]
    pub fn step_limit(&self) -> u32 {
        let metres = self.starts().count() as f64 * self.corridor_width;
        (libm::ceil(STEPS_PER_METRE * metres - 1e-9) as u32).max(LEAST_STEPS)
    }

    /// Whether a way leads from a position to the destination: whether it lies in a cell that is not
    /// walled off from it.
    #[must_use]
    pub fn leads_on(&self, position: Point) -> bool {
        let cell = self.world.cell_at(position);
        cell.is_some_and(|cell| self.steps_from(cell).is_some())
    }

    /// Where the robot is to go; `None` if the maze does not say.
    #[must_use]
    pub fn destination(&self) -> Option<&Zone> {
        self.world.zone("destination")
    }

    /// Whether a position lies in the destination.
    #[must_use]
    pub fn is_destination(&self, position: Point) -> bool {
        self.destination()
            .is_some_and(|zone| zone.contains(position))
    }

    /// The cells a run may start from: those outside the destination that can reach it.
    pub fn starts(&self) -> impl Iterator<Item = Cell> + '_ {
        let cells = self.maze.grid().cells();
        cells.filter(|cell| self.steps_from(*cell).is_some_and(|steps| steps > 0))
    }

    fn steps_from(&self, cell: Cell) -> Option<u32> {
        self.steps_to_goal[self.maze.grid().index(cell)]
    }

    /// The length of the shortest way from the marked start to the destination, m; `None` if there is none.
    #[must_use]
    pub fn shortest_metres(&self) -> Option<f64> {
        let (start, _) = self.maze.start()?;
        Some(f64::from(self.steps_from(start)?) * self.corridor_width)
    }

    /// The first of four cells without a wall between them, if there are any: in rooms a robot that follows corridors may go round
    /// for ever and take one way out for another.
    #[must_use]
    pub fn room(&self) -> Option<Cell> {
        let mut cells = self.maze.grid().cells();
        cells.find(|cell| self.maze.is_room(*cell))
    }

    /// Returns a robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If the robot cannot stand there.
    pub fn robot_at<M: Model>(
        &self,
        start: Pose,
        robot: M,
        seed: u64,
    ) -> Result<Simulated<M>, PlaceError> {
        Simulated::new(Arc::clone(&self.world), robot, start, seed)
    }

    /// The middle of a cell, looking in a direction.
    #[must_use]
    pub fn in_cell(&self, cell: Cell, direction: Direction) -> Pose {
        Pose::new(self.world.cell_centre(cell), heading_of(direction))
    }

    /// The middle of the cell that the maze marks as its start, looking as it says.
    ///
    /// # Errors
    /// [`CourseError::NoStart`].
    pub fn start(&self) -> Result<Pose, CourseError> {
        let (cell, direction) = self.maze.start().ok_or(CourseError::NoStart)?;
        Ok(self.in_cell(cell, direction))
    }

    /// A random start: any of [those cells](Self::starts), or of all where there is no destination, with equal chance; any
    /// place in its middle from which the body would stand clear of walls on all four sides, any heading.
    pub fn random_start(&self, body: &Body, rng: &mut impl Rng) -> Pose {
        let mut cells: Vec<Cell> = self.starts().collect();
        if cells.is_empty() {
            cells.extend(self.maze.grid().cells());
        }
        let cell = pick(&cells, rng).unwrap_or(Cell::new(0, 0));
        let play = (0.5 * self.corridor_width - body.radius()).max(0.0) * 0.99;
        let offset = Vector::new(
            rng.random_range(-play..=play),
            rng.random_range(-play..=play),
        );
        let heading = Heading::from_radians(rng.random_range(-PI..PI));
        Pose::new(self.world.cell_centre(cell) + offset, heading)
    }

    /// The middle of any cell from which the destination can be reached, looking along a way out of it; `None` if there are none.
    #[must_use]
    pub fn anywhere(&self, seed: u64) -> Option<Pose> {
        let out_of = |cell| {
            let neighbours = self.maze.neighbours(cell);
            neighbours.map(move |(direction, _)| (cell, direction))
        };
        let ways: Vec<(Cell, Direction)> = self.maze.reachable().flat_map(out_of).collect();
        let (cell, direction) = pick(&ways, &mut stream(seed, 0))?;
        Some(self.in_cell(cell, direction))
    }
}

fn pick<T: Copy>(all: &[T], rng: &mut impl Rng) -> Option<T> {
    if all.is_empty() {
        return None;
    }
    Some(all[rng.random_range(0..all.len() as u32) as usize])
}
