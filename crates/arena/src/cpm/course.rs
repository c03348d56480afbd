use tolman_maze::MazeFile;

use super::robots::epuck;
use crate::course::{Course, CourseError};

/// From wall to wall where nothing else is said, m.
pub const CORRIDOR_WIDTH: f64 = 0.25;

/// The narrowest and the widest corridors, m, in which Mazes 1 to 3 are learned rightly: in others the robot takes bends for junctions and
/// overlooks others.
const WIDTHS: (f64, f64) = (0.20, 0.30);

/// Returns a maze file as a course from its start for the e-puck; `name` is for one that has none.
///
/// # Errors
/// [`CourseError::NoStart`], [`CourseError::Unseen`].
pub fn epuck_course(name: &str, file: MazeFile) -> Result<Course, CourseError> {
    let width = file.corridor_width.unwrap_or(CORRIDOR_WIDTH);
    let (least, most) = WIDTHS;
    if !(least..=most).contains(&width) {
        return Err(CourseError::Unseen {
            width,
            least,
            most,
            reach: epuck().response.reach(),
        });
    }
    let course = Course::new(file.name.as_deref().unwrap_or(name), file.maze, width)?;
    course.start()?;
    Ok(course)
}
