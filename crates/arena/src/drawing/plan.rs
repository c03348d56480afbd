use core::f64::consts::TAU;

use tolman_draw::{FloorPlan, ZoneStyle};
use tolman_geom::{Heading, Point};
use tolman_sim::{Area, Bounds};

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
        plan.zone(&corners(area), ZoneStyle::Destination);
    }
    plan
}

/// Number of corners of the polygon that a disc is drawn as.
const DISC_CORNERS: u32 = 48;

/// Returns the corners of a part of the floor.
fn corners(area: &Area) -> Vec<Point> {
    match *area {
        Area::Rectangle(Bounds { min, max }) => {
            vec![min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]
        }
        Area::Disc { centre, radius } => {
            let turn = |corner| TAU * f64::from(corner) / f64::from(DISC_CORNERS);
            let corner = |corner| centre + radius * Heading::from_radians(turn(corner)).unit();
            (0..DISC_CORNERS).map(corner).collect()
        }
    }
}
