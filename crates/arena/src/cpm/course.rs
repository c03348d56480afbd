use tolman_maze::MazeFile;
use tolman_robot::Body;
use tolman_robot::epuck::BODY_RADIUS;

use super::robots::epuck;
use crate::course::{Course, CourseError, Terrain};

/// Width of corridors from wall to wall if the maze file gives none, m.
pub const CORRIDOR_WIDTH: f64 = 0.25;

/// Minimum and maximum width of corridors, m, at which Mazes 1 to 3 are learned correctly. In
/// others the robot mistakes bends for junctions and overlooks junctions.
const WIDTHS: (f64, f64) = (0.20, 0.30);

/// Returns a maze file as a course from its start for the e-puck; `name` is used if the file has
/// none.
///
/// # Errors
/// [`CourseError::NoStart`], [`CourseError::Unseen`].
pub fn epuck_course(name: &str, file: MazeFile) -> Result<Course, CourseError> {
    let course = epuck_maze(name, file)?;
    course.start()?;
    Ok(course)
}

fn epuck_maze(name: &str, file: MazeFile) -> Result<Course, CourseError> {
    let width = seen(file.corridor_width)?;
    Course::new(file.name.as_deref().unwrap_or(name), file.maze, width)
}

/// Returns a maze or a free world as a course for the e-puck. `name` is used if it has no name
/// itself.
///
/// # Errors
/// [`CourseError::Unseen`], and as [`Course::in_free_world`].
pub fn epuck_course_on(name: &str, terrain: &Terrain) -> Result<Course, CourseError> {
    match terrain {
        Terrain::Maze(file) => epuck_maze(name, file.clone()),
        Terrain::Free(free) => {
            let radius = BODY_RADIUS;
            let width = seen(free.corridor_width)?;
            let world = free.world.clone();
            Course::in_free_world(name, world, width, &Body::Circle { radius })
        }
    }
}

/// Returns the width of the corridors, m, if the e-puck can recognize corridors so wide.
fn seen(width: Option<f64>) -> Result<f64, CourseError> {
    let width = width.unwrap_or(CORRIDOR_WIDTH);
    let (least, most) = WIDTHS;
    match (least..=most).contains(&width) {
        true => Ok(width),
        false => Err(CourseError::Unseen {
            width,
            least,
            most,
            reach: epuck().response.reach(),
        }),
    }
}
