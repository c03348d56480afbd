//! A run drawn over its maze.

use tolman::course::Course;
use tolman::draw::{Figure, Plan, Series};
use tolman::episode::Episode;
use tolman_geom::Point;

/// Width of the picture, user units.
const WIDTH: f64 = 640.0;

/// The SVG text of the maze with the robot's way through it; `told` says the outcome.
pub(super) fn of(course: &Course, episode: &Episode, told: &str) -> String {
    let mut plan = Plan::of_course(course, WIDTH);
    let positions: Vec<Point> = episode.path.iter().map(|pose| pose.position).collect();
    plan.trajectory(&positions, Series(0));
    Figure::new("run", &course.name, plan.drawing(told)).standalone()
}
