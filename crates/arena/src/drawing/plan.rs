use tolman_draw::{FloorPlan, ZoneStyle};

use crate::course::Course;

/// Returns a plan of a course, `width` user units wide, with its walls and its destination.
/// Walled-off parts are solid.
#[must_use]
pub fn plan_of_course(course: &Course, width: f64) -> FloorPlan {
    let world = &course.world;
    let mut plan = FloorPlan::of_world(world, width);
    let cells = course.maze.grid().cells();
    // In a free world no robot can be right beside a wall, and yet that is floor.
    for cell in cells.filter(|_| !course.is_free()) {
        let centre = world.cell_centre(cell);
        if !course.leads_on(centre) {
            plan.square(centre, course.corridor_width, ZoneStyle::Solid);
        }
    }
    let destination = world.zone("destination");
    for area in destination.into_iter().flat_map(tolman_sim::Zone::areas) {
        plan.zone(&area.outline(), ZoneStyle::Destination);
    }
    plan
}
