use tolman_arena::course::Course;
use tolman_draw::{Plan, Zone};
use tolman_geom::{Point, Vector};
use tolman_sim::{Area, Bounds};

/// A plan of a course that is `width` user units wide, with its walls and its destination; what is
/// walled off is solid.
#[must_use]
pub fn plan_of_course(course: &Course, width: f64) -> Plan {
    let world = &course.world;
    let mut plan = Plan::of_world(world, width);
    for cell in course.maze.grid().cells() {
        let centre = world.cell_centre(cell);
        if !course.leads_on(centre) {
            let half = 0.5 * course.corridor_width;
            let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
            let corners = corners.map(|(x, y)| centre + Vector::new(x, y));
            plan.zone(&corners, Zone::Solid);
        }
    }
    let destination = world.zone("destination");
    for area in destination.into_iter().flat_map(tolman_sim::Zone::areas) {
        if let Area::Rectangle(Bounds { min, max }) = *area {
            let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
            plan.zone(&corners, Zone::Destination);
        }
    }
    plan
}
