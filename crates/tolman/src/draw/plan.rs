//! The plan of a world, seen from above.

use core::fmt::Write;

use maud::{Markup, html};
use tolman_geom::{Point, Vector};
use tolman_sim::{Area, Bounds};

use crate::course::Course;

use super::number::tenths;
use super::{Drawing, Series};

/// Free space around the outermost walls, in user units.
const MARGIN: f64 = 8.0;

/// What a zone of the floor means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zone {
    /// Where the robot is to go.
    Destination,
    /// A part of the floor that is told apart.
    Region,
    /// No floor at all: walled off.
    Solid,
}

/// A plan to which layers are added from the bottom up. World coordinates are metres, x to the
/// right and y upwards.
#[derive(Clone, Debug)]
pub struct Plan {
    west: f64,
    north: f64,
    /// User units per metre.
    scale: f64,
    width: f64,
    height: f64,
    layers: Vec<Markup>,
    walls: Markup,
}

impl Plan {
    /// A plan that is `width` user units wide and holds all walls. Walls lie above every layer.
    /// Without a wall of some extent the plan shows one square metre around it.
    pub fn of_walls(walls: &[[Point; 2]], width: f64) -> Self {
        let (mut min, mut max) = (
            Point::new(f64::MAX, f64::MAX),
            Point::new(f64::MIN, f64::MIN),
        );
        for end in walls.iter().flatten() {
            min = Point::new(min.x.min(end.x), min.y.min(end.y));
            max = Point::new(max.x.max(end.x), max.y.max(end.y));
        }
        if max.x < min.x || max.y < min.y {
            (min, max) = (Point::origin(), Point::origin());
        }
        let (extent_x, extent_y) = (max.x - min.x, max.y - min.y);
        let extent_x = if extent_x > 0.0 { extent_x } else { 1.0 };
        let extent_y = if extent_y > 0.0 { extent_y } else { 1.0 };
        let scale = (width - 2.0 * MARGIN) / extent_x;
        let mut plan = Self {
            west: min.x,
            north: min.y + extent_y,
            scale,
            width,
            height: scale * extent_y + 2.0 * MARGIN,
            layers: Vec::new(),
            walls: html! {},
        };
        let mut path = String::new();
        for [from, to] in walls {
            let ((x0, y0), (x1, y1)) = (plan.at(*from), plan.at(*to));
            // Writing to a string cannot fail.
            let _ = write!(
                path,
                "M{} {}L{} {}",
                tenths(x0),
                tenths(y0),
                tenths(x1),
                tenths(y1)
            );
        }
        plan.walls = html! { path class="wall" stroke-width="2.5" d=(path) {} };
        plan
    }

    /// A plan of a course that is `width` user units wide, with its walls and its destination; what is
    /// walled off is solid.
    pub fn of_course(course: &Course, width: f64) -> Self {
        let world = &course.world;
        let walls: Vec<[Point; 2]> = world
            .walls()
            .iter()
            .map(|wall| [wall.start, wall.end])
            .collect();
        let mut plan = Self::of_walls(&walls, width);
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

    /// Adds a zone given by its corners in order.
    pub fn zone(&mut self, corners: &[Point], zone: Zone) {
        let class = match zone {
            Zone::Destination => "destination",
            Zone::Region => "region",
            Zone::Solid => "solid",
        };
        let path = self.path(corners);
        self.layers
            .push(html! { path class=(class) d={ (path) "Z" } {} });
    }

    /// Adds a trajectory with a ring at its start and a dot at its end.
    pub fn trajectory(&mut self, positions: &[Point], series: Series) {
        let (Some(start), Some(end)) = (positions.first(), positions.last()) else {
            return;
        };
        let path = self.path(positions);
        let ((start_x, start_y), (end_x, end_y)) = (self.at(*start), self.at(*end));
        self.layers.push(html! {
            g class=(series.class()) {
                path class="trajectory" d=(path) {}
                circle class="start" cx=(tenths(start_x)) cy=(tenths(start_y)) r="4" {}
                circle class="end" cx=(tenths(end_x)) cy=(tenths(end_y)) r="4.5" {}
            }
        });
    }

    /// Adds a thin trajectory without ends, for many in one plan.
    pub fn faint_trajectory(&mut self, positions: &[Point], series: Series) {
        let path = self.path(positions);
        self.layers.push(html! {
            path class={ "trajectory faint " (series.class()) } d=(path) {}
        });
    }

    /// Adds a word centred at a position.
    pub fn label(&mut self, position: Point, text: &str) {
        let (x, y) = self.at(position);
        self.layers.push(html! {
            text x=(tenths(x)) y=(tenths(y)) text-anchor="middle" dominant-baseline="central" {
                (text)
            }
        });
    }

    /// Adds SVG elements of the caller's own; [`Self::at`] gives their coordinates.
    pub fn layer(&mut self, elements: Markup) {
        self.layers.push(elements);
    }

    /// Where a world position lies on the plan, in user units.
    pub fn at(&self, position: Point) -> (f64, f64) {
        (
            MARGIN + (position.x - self.west) * self.scale,
            MARGIN + (self.north - position.y) * self.scale,
        )
    }

    /// The finished picture; `description` says in words what it shows.
    pub fn drawing(self, description: impl Into<String>) -> Drawing {
        let body = html! {
            rect class="floor" width=(tenths(self.width)) height=(tenths(self.height)) {}
            @for layer in &self.layers { (layer) }
            (self.walls)
        };
        Drawing {
            width: self.width,
            height: self.height,
            description: description.into(),
            body,
        }
    }

    /// SVG path data through positions; those that round to the place before are left out.
    fn path(&self, positions: &[Point]) -> String {
        let mut path = String::new();
        let mut last = (String::new(), String::new());
        for position in positions {
            let (x, y) = self.at(*position);
            let here = (tenths(x), tenths(y));
            if here != last {
                let verb = if path.is_empty() { 'M' } else { 'L' };
                // Writing to a string cannot fail.
                let _ = write!(path, "{verb}{} {}", here.0, here.1);
                last = here;
            }
        }
        path
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Plan {
        let corners =
            [(1.0, 1.0), (5.0, 1.0), (5.0, 3.0), (1.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let walls: Vec<_> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
        Plan::of_walls(&walls, 2.0 * MARGIN + 400.0)
    }

    #[test]
    fn y_grows_upwards_and_the_scale_is_the_same_in_both_directions() {
        let plan = square();
        assert_eq!(plan.at(Point::new(1.0, 3.0)), (MARGIN, MARGIN));
        assert_eq!(
            plan.at(Point::new(5.0, 1.0)),
            (MARGIN + 400.0, MARGIN + 200.0)
        );
    }

    #[test]
    fn positions_that_round_alike_are_drawn_once() {
        let plan = square();
        let path =
            plan.path(&[(1.0, 3.0), (1.0001, 3.0), (2.0, 3.0)].map(|(x, y)| Point::new(x, y)));
        assert_eq!(path, "M8 8L108 8");
    }

    #[test]
    fn no_walls_and_no_positions_give_an_empty_plan() {
        let mut plan = Plan::of_walls(&[], 100.0);
        plan.trajectory(&[], Series(0));
        let drawing = plan.drawing("nothing");
        assert!(drawing.height.is_finite());
        assert!(!drawing.body.into_string().contains("trajectory"));
    }
}
