//! Draws a run over its maze.

use tolman_arena::course::Course;
use tolman_draw::{Figure, Series};
use tolman_geom::{Point, Pose};

/// Width of the picture, user units.
const WIDTH: f64 = 640.0;

/// Returns the SVG text of the maze with the robot's way through it. `told` is the caption.
pub(super) fn of(course: &Course, path: &[Pose], told: &str) -> String {
    of_runs(course, &[path], told)
}

/// Returns the SVG text of the maze with several ways. The last one is on top, in the first colour.
pub(super) fn of_runs(course: &Course, paths: &[&[Pose]], told: &str) -> String {
    let mut plan = tolman_arena::drawing::plan_of_course(course, WIDTH);
    let paths = paths.iter().filter(|path| !path.is_empty());
    let colours = (0..paths.clone().count() as u32).rev();
    for (colour, path) in colours.zip(paths) {
        let positions: Vec<Point> = path.iter().map(|pose| pose.position).collect();
        plan.trajectory(&positions, Series(colour));
    }
    Figure::new("run", &course.name, plan.drawing(told)).standalone()
}
