use alloc::collections::BTreeSet;

use rand::Rng;
use tolman_maze::{Cell, MazeFile};
use tolman_robot::Body;
use tolman_sim::{Area, World, Zone};

use super::paving::Paving;
use super::{Course, CourseError, pick};
use crate::pioneer::CORRIDOR_WIDTH;

/// Worlds that robots can be sent into: a maze, or free walls.
#[derive(Clone, Debug)]
pub enum Terrain {
    /// A maze of cells.
    Maze(MazeFile),
    /// Free walls, or an occupancy grid.
    Free(FreeWorld),
}

/// A world whose walls stand anywhere.
#[derive(Clone, Debug)]
pub struct FreeWorld {
    /// Walls and doors, with the zone `destination` and perhaps the zone `start`.
    pub world: World,
    /// Width of its corridors for control layers and detectors, m; `None` for that of the robot's
    /// mazes.
    pub corridor_width: Option<f64>,
}

impl FreeWorld {
    /// Returns the world with a destination: its own, or else a disc of half a metre somewhere on
    /// the largest floor on which a robot of this `body` can drive about. O(area).
    ///
    /// # Errors
    /// If the robot fits nowhere, or the world is too large for it.
    pub fn with_destination(&self, body: &Body, rng: &mut impl Rng) -> Result<Self, CourseError> {
        if self.world.zone(DESTINATION).is_some() {
            return Ok(self.clone());
        }
        let paving = Paving::of(&self.world, body)?;
        let floor = paving.maze(&self.world);
        let mut left: BTreeSet<Cell> = (floor.grid().cells())
            .filter(|cell| floor.degree(*cell) > 0)
            .collect();
        let mut largest: Vec<Cell> = Vec::new();
        while let Some(first) = left.pop_first() {
            let mut together = vec![first];
            let mut next = 0;
            while let Some(cell) = together.get(next).copied() {
                let beside = floor.neighbours(cell).map(|(_, beside)| beside);
                together.extend(beside.filter(|beside| left.remove(beside)));
                next += 1;
            }
            if together.len() > largest.len() {
                largest = together;
            }
        }
        let diameter = 2.0 * body.radius();
        let goal = pick(&largest, rng).ok_or(CourseError::CutOffWorld { diameter })?;
        let disc = Area::Disc {
            centre: paving.centre(goal),
            radius: RADIUS,
        };
        let world = self.world.clone();
        Ok(Self {
            world: world.with_zone(Zone::new(DESTINATION, vec![disc]))?,
            ..self.clone()
        })
    }
}

/// Zone to which robots are sent.
const DESTINATION: &str = "destination";

/// Radius of a destination, m.
const RADIUS: f64 = 0.5;

impl Terrain {
    /// Returns the maze, for requests that work in mazes only; `what` names the request, as in "the
    /// oracle".
    ///
    /// # Errors
    /// [`CourseError::NoMaze`] for a free world.
    pub fn maze(&self, what: &'static str) -> Result<&MazeFile, CourseError> {
        match self {
            Self::Maze(file) => Ok(file),
            Self::Free(_) => Err(CourseError::NoMaze { what }),
        }
    }

    /// Returns the terrain as a course to its destination for a robot of this `body`. Corridors
    /// have its width, or else MSLST's 1.9 robot units. See [`Course::for_body`] and
    /// [`Course::in_free_world`].
    ///
    /// # Errors
    /// As those.
    pub fn course(&self, name: &str, body: &Body) -> Result<Course, CourseError> {
        self.course_with(name, body, CORRIDOR_WIDTH)
    }

    /// Returns the same course; in a maze whose file gives no width, corridors are `usual_width` m
    /// wide.
    ///
    /// # Errors
    /// As [`course`](Self::course).
    pub fn course_with(
        &self,
        name: &str,
        body: &Body,
        usual_width: f64,
    ) -> Result<Course, CourseError> {
        match self {
            Self::Maze(file) => {
                let mut file = file.clone();
                file.corridor_width.get_or_insert(usual_width);
                Course::for_body(name, &file, body)
            }
            Self::Free(free) => {
                let width = free.corridor_width.unwrap_or(CORRIDOR_WIDTH);
                Course::in_free_world(name, free.world.clone(), width, body)
            }
        }
    }
}

impl From<MazeFile> for Terrain {
    fn from(file: MazeFile) -> Self {
        Self::Maze(file)
    }
}
