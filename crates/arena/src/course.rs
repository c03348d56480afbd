//! A maze or a free world made ready for runs: its walls, its corridors, and where runs may begin.

mod paving;
mod terrain;
#[cfg(test)]
mod tests;

use alloc::collections::VecDeque;
use alloc::sync::Arc;
use core::f64::consts::PI;
use core::hash::Hasher;

use fnv::FnvHasher;
use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_control::heading_of;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::{Cell, Direction, Maze, MazeFile};
use tolman_robot::{Body, Landmark};
use tolman_sim::{CorridorSize, Model, PlaceError, World, WorldError, WorldFileError, Zone};
use tolman_systems::stream;

use self::paving::Paving;
use crate::pioneer::CORRIDOR_WIDTH;
use crate::simulated::landmark_of;
use crate::{Simulated, taut_way};

pub use terrain::{FreeWorld, Terrain};

/// Reason why no robot can run in a maze or a world.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CourseError {
    /// The maze marks no destination.
    #[error("the maze marks no destination: mark its cells with G")]
    NoDestination,
    /// The maze marks no start.
    #[error("the maze marks no start: mark a cell with S")]
    NoStart,
    /// No cell is left to start from: every cell that can reach the destination is part of it.
    #[error("no cell outside the destination can reach it: open a way to it")]
    CutOff,
    /// The world has no destination.
    #[error("the world has no zone `destination`: add one to its file, or put it with --goal X,Y")]
    NoDestinationZone,
    /// The world has no start.
    #[error("the world has no zone `start`: add one to its file")]
    NoStartZone,
    /// A world has no place to start from.
    #[error(
        "nowhere outside the destination can a robot {diameter} m across stand and reach it: open a way that is at least half its radius wider, or put the destination elsewhere with --goal X,Y"
    )]
    CutOffWorld {
        /// The robot's diameter, m.
        diameter: f64,
    },
    /// The world is too large for the robot.
    #[error(
        "a world of {width} × {height} m is too large for a robot {diameter} m across: cut a part out of it"
    )]
    TooVast {
        /// Extent from west to east, m.
        width: f64,
        /// Extent from south to north, m.
        height: f64,
        /// The robot's diameter, m.
        diameter: f64,
    },
    /// The request works in mazes only.
    #[error(
        "{what} needs a maze of cells, and this is a world whose walls stand anywhere: give a maze, with --maze"
    )]
    NoMaze {
        /// Name of the thing that needs a maze.
        what: &'static str,
    },
    /// The corridors are too narrow for the robot.
    #[error(
        "a robot {diameter} m across does not fit corridors {width} m wide: leave `corridor_width` out of the maze file for corridors that fit, or give a larger one; for a world, give a larger --corridor"
    )]
    TooNarrow {
        /// The robot's diameter, m.
        diameter: f64,
        /// The corridors' width, m.
        width: f64,
    },
    /// The e-puck cannot recognize such corridors.
    #[error(
        "the corridors are {width} m wide; an e-puck, whose sensors reach {reach} m, recognizes junctions only in corridors of {least} to {most} m: set \
         corridor_width to 0.25, or leave it out"
    )]
    Unseen {
        /// Width from wall to wall, m.
        width: f64,
        /// Minimum width, m.
        least: f64,
        /// Maximum width, m.
        most: f64,
        /// Range of the e-puck's sensors, m.
        reach: f64,
    },
    /// The world cannot be built.
    #[error("no world can be built from the maze; correct the maze or its corridor width")]
    World(#[from] WorldError),
    /// The world cannot be written as a file.
    #[error("the world cannot be written as a file")]
    Unwritten(#[from] WorldFileError),
}

/// A world with corridors of one width, a destination if there is one, and places to start from.
///
/// Most are mazes. In a [free world](Self::in_free_world) walls stand anywhere; there the cells are
/// squares with sides of half the robot's radius.
#[derive(Clone, Debug)]
pub struct Course {
    /// Name of the maze or of the file.
    pub name: String,
    /// The maze it was built from. For a free world: its squares, with walls where the robot cannot
    /// pass from the middle of one to that of the next. If you need corridors and junctions as
    /// cells, check [`is_free`](Self::is_free) first.
    pub maze: Maze,
    /// Walls and zones of the course.
    pub world: Arc<World>,
    /// Width of the corridors from wall to wall, m.
    pub corridor_width: f64,
    /// Number of cells to the destination, by cell index; `None` where no way leads there.
    steps_to_goal: Vec<Option<u32>>,
    /// Floor of a free world; `None` for a maze.
    free: Option<FreeFloor>,
}

/// Part of a course that only a free world has.
#[derive(Clone, Debug)]
struct FreeFloor {
    paving: Paving,
    start: Option<Pose>,
    /// The world's file.
    text: Arc<str>,
}

/// MSLST gives a robot 500 time steps in its Large maze; the first one drawn here has 63 cells to
/// start from, each [`CORRIDOR_WIDTH`] wide.
const STEPS_PER_METRE: f64 = 500.0 / (63.0 * CORRIDOR_WIDTH);

/// Minimum limit of a course, time steps: even on a short one a robot has to turn round.
const LEAST_STEPS: u32 = 100;

impl Course {
    /// Returns a maze of thin walls with corridors `corridor_width` wide, m.
    ///
    /// # Errors
    /// [`CourseError::World`] if the corridors have no width.
    pub fn new(name: &str, maze: Maze, corridor_width: f64) -> Result<Self, CourseError> {
        let world = World::from_maze(&maze, &CorridorSize::thin(corridor_width))?;
        Ok(Self::in_world(name, maze, corridor_width, world))
    }

    /// Returns a maze whose walls stand in `world`, with corridors `corridor_width` wide, m.
    #[must_use]
    pub fn in_world(name: &str, maze: Maze, corridor_width: f64, world: World) -> Self {
        Self {
            name: name.to_owned(),
            steps_to_goal: maze.steps_to_goal(),
            maze,
            world: Arc::new(world),
            corridor_width,
            free: None,
        }
    }

    /// Returns a world of free walls as a course to its zone `destination`. The robot has this
    /// `body`, and its layers take corridors to be `corridor_width` m wide. Doors count as open.
    ///
    /// A passage may count as closed if it is wider than the body by less than half its radius.
    /// O(area), and O(length) for each wall.
    ///
    /// # Errors
    /// [`CourseError`] if the world has no destination or none that can be reached, or the robot
    /// does not fit.
    pub fn in_free_world(
        name: &str,
        world: World,
        corridor_width: f64,
        body: &Body,
    ) -> Result<Self, CourseError> {
        let diameter = 2.0 * body.radius();
        if corridor_width <= diameter {
            let width = corridor_width;
            return Err(CourseError::TooNarrow { diameter, width });
        }
        world
            .zone("destination")
            .ok_or(CourseError::NoDestinationZone)?;
        let paving = Paving::of(&world, body)?;
        let maze = paving.maze(&world);
        let free = FreeFloor {
            start: paving.start(&maze, &world),
            text: world.to_json()?.into(),
            paving,
        };
        let course = Self {
            free: Some(free),
            ..Self::in_world(name, maze, corridor_width, world)
        };
        let mut starts = course.starts();
        starts.next().ok_or(CourseError::CutOffWorld { diameter })?;
        drop(starts);
        Ok(course)
    }

    /// Returns whether the course is a free world, in which walls stand anywhere.
    #[must_use]
    pub const fn is_free(&self) -> bool {
        self.free.is_some()
    }

    /// Refuses a free world for requests that work in mazes only; `what` names the request, as in
    /// "the oracle".
    ///
    /// # Errors
    /// [`CourseError::NoMaze`] in a free world.
    pub const fn needs_maze(&self, what: &'static str) -> Result<(), CourseError> {
        match self.is_free() {
            true => Err(CourseError::NoMaze { what }),
            false => Ok(()),
        }
    }

    /// Returns how far the middle of a robot stays from the walls of a free world, m; `None` in a
    /// maze.
    pub(crate) fn free_radius(&self) -> Option<f64> {
        Some(self.free.as_ref()?.paving.radius)
    }

    /// Returns the distance between the middles of two neighbouring cells, m.
    #[must_use]
    pub fn pitch(&self) -> f64 {
        match &self.free {
            Some(free) => free.paving.pitch,
            None => 2.0 * self.world.cell_centre(Cell::new(0, 0)).x,
        }
    }

    /// Returns the middle of a cell.
    #[must_use]
    pub fn cell_centre(&self, cell: Cell) -> Point {
        match &self.free {
            Some(free) => free.paving.centre(cell),
            None => self.world.cell_centre(cell),
        }
    }

    /// Returns a maze file as a course to its destination for a robot of this `body`. The file's
    /// corridor width counts, or else MSLST's 1.9 robot units.
    ///
    /// # Errors
    /// [`CourseError`] if the maze has no destination or none that can be reached, or the robot
    /// does not fit.
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

    /// Returns a fingerprint of the drawing, which tells it from others of its name: a hash of
    /// walls, marks and the corridors' width. For a free world, a hash of walls, zones and doors.
    #[must_use]
    pub fn drawing(&self) -> String {
        let text = match &self.free {
            Some(free) => free.text.to_string(),
            None => format!("{}{}", self.maze, self.corridor_width),
        };
        let mut hash = FnvHasher::default();
        hash.write(text.as_bytes());
        format!("{:016x}", hash.finish())
    }

    /// Returns the default number of time steps after which a run has failed. It is proportional to
    /// the length of the corridors, with as many steps per metre as MSLST has in its Large maze.
    #[must_use]
    pub fn step_limit(&self) -> u32 {
        let metres = self.corridor_metres();
        (libm::ceil(STEPS_PER_METRE * metres - 1e-9) as u32).max(LEAST_STEPS)
    }

    /// Returns the length of all corridors, m. In a free world these are corridors that cover its
    /// floor.
    #[must_use]
    pub fn corridor_metres(&self) -> f64 {
        let of_a_cell = match &self.free {
            Some(free) => free.paving.metres_per_cell(self.corridor_width),
            None => self.corridor_width,
        };
        self.starts().count() as f64 * of_a_cell
    }

    /// Returns whether a way leads from a position to the destination: whether its cell is not
    /// walled off. In a free world, one of the squares beside it is enough.
    #[must_use]
    pub fn leads_on(&self, position: Point) -> bool {
        if let Some(free) = &self.free {
            let mut around = free.paving.around(position);
            return around.any(|cell| self.steps_from(cell).is_some());
        }
        let cell = self.world.cell_at(position);
        cell.is_some_and(|cell| self.steps_from(cell).is_some())
    }

    /// Returns the zone to which the robot has to go; `None` if the course has no destination.
    #[must_use]
    pub fn destination(&self) -> Option<&Zone> {
        self.world.zone("destination")
    }

    /// Returns the zone in which a landmark is sensed; `None` if the course does not have it.
    #[must_use]
    pub fn zone_of(&self, landmark: Landmark) -> Option<&Zone> {
        let mut zones = self.world.zones().iter();
        zones.find(|zone| landmark_of(zone) == Some(landmark))
    }

    /// Returns whether a position lies in the destination.
    #[must_use]
    pub fn is_destination(&self, position: Point) -> bool {
        self.destination()
            .is_some_and(|zone| zone.contains(position))
    }

    /// Returns the cells a run may start from: those outside the destination that can reach it.
    pub fn starts(&self) -> impl Iterator<Item = Cell> + '_ {
        let cells = self.maze.grid().cells();
        cells.filter(|cell| self.steps_from(*cell).is_some_and(|steps| steps > 0))
    }

    fn steps_from(&self, cell: Cell) -> Option<u32> {
        self.steps_to_goal[self.maze.grid().index(cell)]
    }

    /// Returns the length of the shortest way from the marked start to the destination, m; `None`
    /// if there is none. In a free world it is the length along squares, which may be longer by a
    /// factor of up to √2.
    #[must_use]
    pub fn shortest_metres(&self) -> Option<f64> {
        self.shortest_metres_from(self.start().ok()?.position)
    }

    /// Returns the length of the shortest way to the destination from the cell of `position`, m.
    #[must_use]
    pub fn shortest_metres_from(&self, position: Point) -> Option<f64> {
        if let Some(free) = &self.free {
            let cell = free.paving.cell_at(position)?;
            return Some(f64::from(self.steps_from(cell)?) * free.paving.pitch);
        }
        let cell = self.world.cell_at(position)?;
        Some(f64::from(self.steps_from(cell)?) * self.corridor_width)
    }

    /// Returns the length of a shortest way on which the middle of a robot comes into the
    /// destination, m; `None` if there is none. The body of the robot holds a disc with this
    /// `radius`, m, which touches no wall.
    #[must_use]
    pub fn shortest_drive(&self, from: Point, radius: f64) -> Option<f64> {
        // A quarter of the disc is left to the grid.
        let pitch = 0.25 * radius;
        let radius = radius - pitch;
        let body = Body::Circle { radius };
        let is_floor = |at: Point| self.world.clear_for(&body, Pose::new(at, Heading::EAST));
        let left = |at: Point| if self.is_destination(at) { 0.0 } else { pitch };
        let way = taut_way(from, pitch, is_floor, left)?;
        Some(
            way.windows(2)
                .map(|piece| (piece[1] - piece[0]).norm())
                .sum(),
        )
    }

    /// Returns the middles of the cells at which a shortest way from one position to another turns;
    /// `None` if there is none. O(cells).
    #[must_use]
    pub fn turns_between(&self, from: Point, to: Point) -> Option<Vec<Point>> {
        let cell_at = |at: Point| match &self.free {
            Some(free) => free.paving.cell_at(at),
            None => self.world.cell_at(at),
        };
        let (from, to) = (cell_at(from)?, cell_at(to)?);
        // The direction to the next cell of the way.
        let mut onward: Vec<Option<Direction>> = vec![None; self.maze.grid().cells().count()];
        let mut left = VecDeque::from([to]);
        while let Some(cell) = left.pop_front() {
            if cell == from {
                break;
            }
            for (way, next) in self.maze.neighbours(cell) {
                let known = &mut onward[self.maze.grid().index(next)];
                if known.is_none() && next != to {
                    *known = Some(way.opposite());
                    left.push_back(next);
                }
            }
        }
        let (mut at, mut ahead, mut turns) = (from, None, vec![self.cell_centre(from)]);
        while at != to {
            let way = onward[self.maze.grid().index(at)]?;
            if ahead.is_some_and(|ahead| ahead != way) {
                turns.push(self.cell_centre(at));
            }
            ahead = Some(way);
            at = self.maze.beside(at, way)?;
        }
        turns.push(self.cell_centre(to));
        Some(turns)
    }

    /// Returns the first of four cells without a wall between them; `None` if there are none, and
    /// in a free world. In rooms a robot that follows corridors may go round forever, and confuse
    /// ways out.
    #[must_use]
    pub fn room(&self) -> Option<Cell> {
        if self.is_free() {
            return None;
        }
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

    /// Returns the middle of a cell, looking in a direction.
    #[must_use]
    pub fn in_cell(&self, cell: Cell, direction: Direction) -> Pose {
        Pose::new(self.cell_centre(cell), heading_of(direction))
    }

    /// Returns the start. In a maze it is the middle of the cell and the heading that the maze
    /// marks. In a free world it is the middle of the zone `start`, looking along the longest clear
    /// way.
    ///
    /// # Errors
    /// [`CourseError::NoStart`], [`CourseError::NoStartZone`].
    pub fn start(&self) -> Result<Pose, CourseError> {
        if let Some(free) = &self.free {
            return free.start.ok_or(CourseError::NoStartZone);
        }
        let (cell, direction) = self.maze.start().ok_or(CourseError::NoStart)?;
        Ok(self.in_cell(cell, direction))
    }

    /// Returns a random start: the middle of a random cell, with a random heading. The cell is one
    /// of [`starts`](Self::starts), or any if there is no destination. The body stands clear of
    /// walls there. In a free world it is the middle of a square.
    pub fn random_start(&self, body: &Body, rng: &mut impl Rng) -> Pose {
        let mut cells: Vec<Cell> = self.starts().collect();
        if cells.is_empty() {
            cells.extend(self.maze.grid().cells());
        }
        let cell = pick(&cells, rng).unwrap_or(Cell::new(0, 0));
        let play = match self.free {
            Some(_) => 0.0,
            None => (0.5 * self.corridor_width - body.radius()).max(0.0) * 0.99,
        };
        let offset = Vector::new(
            rng.random_range(-play..=play),
            rng.random_range(-play..=play),
        );
        let heading = Heading::from_radians(rng.random_range(-PI..PI));
        Pose::new(self.cell_centre(cell) + offset, heading)
    }

    /// Returns the middle of any cell from which the destination can be reached, looking along a
    /// way out of it; `None` if there are none. In a free world it is moved to the middle between
    /// the obstacles on both sides.
    #[must_use]
    pub fn anywhere(&self, seed: u64) -> Option<Pose> {
        let out_of = |cell| {
            let neighbours = self.maze.neighbours(cell);
            neighbours.map(move |(direction, _)| (cell, direction))
        };
        let ways: Vec<(Cell, Direction)> = self.maze.reachable().flat_map(out_of).collect();
        let (cell, direction) = pick(&ways, &mut stream(seed, 0))?;
        let pose = self.in_cell(cell, direction);
        let amid = |free: &FreeFloor| free.paving.amid(&self.maze, cell, direction);
        let position = self.free.as_ref().map_or(pose.position, amid);
        Some(Pose { position, ..pose })
    }
}

pub(crate) fn pick<T: Copy>(all: &[T], rng: &mut impl Rng) -> Option<T> {
    if all.is_empty() {
        return None;
    }
    all.get(rng.random_range(0..all.len() as u32) as usize)
        .copied()
}
