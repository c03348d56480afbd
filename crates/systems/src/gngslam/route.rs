use tolman_geom::Point;
use tolman_maps::place_graph::PlaceGraph;
use tolman_planners::{Arcs, path_to};
use tolman_robot::Mapper;

/// A way over the places of a map.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Route {
    /// The place it leads to.
    pub(super) goal: u32,
    /// Points still to come to, the next one last.
    points: Vec<Point>,
}

impl Route {
    /// Returns the way of fewest places from the place nearest to `here`; `None` if none is known. O(places + links).
    pub(super) fn find(map: &PlaceGraph, here: Point, goal: u32) -> Option<Self> {
        let view = map.map();
        let links: Vec<(u32, u32, u32)> = (view.links.iter())
            .map(|link| (link.from, link.to, 1))
            .collect();
        let graph = Arcs::new(view.places.len(), &links);
        let path = path_to(&graph, map.nearest(here), |place| place == goal)?;
        let position = |place: &u32| view.places.get(*place as usize)?.position;
        let points = path.iter().rev().filter_map(position).collect();
        Some(Self { goal, points })
    }

    /// Returns the next point to go to, from `here`; `None` at the end. A point is passed within `arrival` m.
    pub(super) fn next(&mut self, here: Point, arrival: f64) -> Option<Point> {
        // Whatever lies behind a point that is near has been passed.
        let near = |point: &Point| (point - here).norm() <= arrival;
        if let Some(passed) = self.points.iter().position(near) {
            self.points.truncate(passed);
        }
        self.points.last().copied()
    }
}
