use tolman_geom::Pose;
use tolman_maze::{Cell, Maze};
use tolman_systems::micromouse::system::{MazeMouse, MazeMouseConfig};
use tolman_systems::micromouse::{Brief, SIDE};

use crate::course::Course;
use crate::cpm::direction_of;
use crate::pioneer::{CORRIDOR_WIDTH, body};
use crate::registry::{Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing};

/// [`MazeMouse`], which is told the grid, its start and the goal.
#[derive(Clone, Copy, Debug)]
pub(super) struct MicromouseEntry;

impl SystemEntry for MicromouseEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "Micromouse",
            about: "is told the grid, the start and the goal, and explores wall by wall",
            is_paper: true,
            why_no_log: WALLS,
            ..SystemFacts::new("micromouse")
        }
    }

    fn abstains(&self, maze: &Maze) -> Option<String> {
        too_large(maze)
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        setup.settings.none()?;
        setup.terrain.maze("the micromouse")?;
        let config = setup.robot.laser_config();
        let course = setup.course(&body(), CORRIDOR_WIDTH)?;
        let start = setup.start(&course, || course.anywhere(setup.seed))?;
        let mouse = MazeMouseConfig::new(
            course.corridor_width,
            config.turn_per_step,
            config.translate_per_step,
        );
        let mouse = MazeMouse::whole_maze(brief_from(&course, start), mouse)?;
        let robot = setup.laser_at(&course, start, config)?;
        Ok(setup.send(self.name(), course, robot, mouse))
    }
}

/// Returns the initial knowledge of a mouse at `start`: the size of the maze, its start and its
/// goals.
pub(super) fn brief_from(course: &Course, start: Pose) -> Brief {
    let cell = course.world.cell_at(start.position);
    Brief {
        grid: course.maze.grid(),
        start: cell.unwrap_or(Cell::new(0, 0)),
        heading: direction_of(start.heading),
        goals: course.maze.goals().to_vec(),
    }
}

/// Reason why a mouse cannot map a log.
pub(super) const WALLS: &str = "it learns the walls of a grid's cells, which a log does not have";

/// Returns why a drawing is too large for a mouse; `None` if it is not.
pub(super) fn too_large(maze: &Maze) -> Option<String> {
    let grid = maze.grid();
    let side = grid.width().max(grid.height()) as usize;
    (side > SIDE).then(|| format!("it knows mazes of at most {SIDE} × {SIDE} cells"))
}
