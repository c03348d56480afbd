//! A run drawn over its maze.

use tolman_arena::course::Course;
use tolman_draw::{Figure, Series};
use tolman_geom::{Point, Pose};

/// Width of the picture, user units.
const WIDTH: f64 = 640.0;

/// The SVG text of the maze with the robot's way through it; `told` says the outcome.
pub(super) fn of(course: &Course, path: &[Pose], told: &str) -> String {
    let mut plan = tolman_papers::plan_of_course(course, WIDTH);
    let positions: Vec<Point> = path.iter().map(|pose| pose.position).collect();
    plan.trajectory(&positions, Series(0));
    Figure::new("run", &course.name, plan.drawing(told)).standalone()
}
