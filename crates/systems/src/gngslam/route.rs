use alloc::collections::BTreeMap;

use tolman_geom::Point;
use tolman_maps::place_graph::PlaceGraph;
use tolman_planners::{Arcs, a_star, costs_from};
use tolman_robot::Mapper;

/// End of a way: a point, and the place beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target {
    pub(super) place: u32,
    pub(super) point: Point,
}

/// A way over the places of a map.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Route {
    /// End of the way.
    pub(super) target: Target,
    /// Places and points still to come to, the next one last.
    ahead: Vec<(u32, Point)>,
    /// The place that was passed last.
    passed: u32,
}

/// Number of times that something blocked the way between two places, the lower one first.
#[derive(Clone, Debug, Default)]
pub(super) struct Obstacles(BTreeMap<(u32, u32), u32>);

impl Obstacles {
    /// Increase of the factor on a link's length for each obstacle met on it.
    const DETOUR: f64 = 4.0;

    /// Records an obstacle on a link.
    pub(super) fn note(&mut self, (a, b): (u32, u32)) {
        *self.0.entry((a.min(b), a.max(b))).or_default() += 1;
    }

    fn factor(&self, a: u32, b: u32) -> f64 {
        let times = self.0.get(&(a.min(b), a.max(b)));
        1.0 + Self::DETOUR * f64::from(times.copied().unwrap_or_default())
    }

    /// Returns the links of a map with their lengths, mm: the distance of their places, and more
    /// where obstacles were met. O(links).
    fn links(&self, map: &PlaceGraph) -> Arcs {
        let poses = map.poses().poses();
        let position = |place: u32| poses.get(place as usize).map(|pose| pose.position);
        let cost = |a, b| {
            let metres = (position(a)? - position(b)?).norm() * self.factor(a, b);
            Some(1 + (1000.0 * metres) as u32)
        };
        let links = map.map().links.into_iter();
        let links = links.filter_map(|link| Some((link.from, link.to, cost(link.from, link.to)?)));
        Arcs::new(poses.len(), &links.collect::<Vec<_>>())
    }

    /// Returns the target whose place has the shortest way from the place nearest to `here`. The
    /// first of equals counts. Returns `None` if no way leads to any target. O(links log places).
    pub(super) fn nearest(
        &self,
        map: &PlaceGraph,
        here: Point,
        targets: Vec<Target>,
    ) -> Option<Target> {
        let costs = costs_from(&self.links(map), [map.nearest(here)]);
        let cost = |target: &Target| costs.get(target.place as usize).copied().flatten();
        let reached = targets.into_iter().filter(|target| cost(target).is_some());
        reached.min_by_key(cost)
    }
}

impl Route {
    /// Returns the shortest way from the place nearest to `here`, with obstacles making links
    /// longer; `None` if none is known. O(links log places).
    pub(super) fn find(
        map: &PlaceGraph,
        here: Point,
        target: Target,
        obstacles: &Obstacles,
    ) -> Option<Self> {
        let poses = map.poses().poses();
        let position = |place: u32| poses.get(place as usize).map(|pose| pose.position);
        let graph = obstacles.links(map);
        let passed = map.nearest(here);
        let found = a_star(&graph, passed, |place| place == target.place, |_| 0)?;
        let places = found.path.iter().rev();
        let mut ahead = vec![(target.place, target.point)];
        ahead.extend(places.filter_map(|place| Some((*place, position(*place)?))));
        Some(Self {
            target,
            ahead,
            passed,
        })
    }

    /// Returns the places on the way.
    pub(super) fn places(&self) -> impl Iterator<Item = u32> + '_ {
        self.ahead.iter().skip(1).rev().map(|(place, _)| *place)
    }

    /// Returns the next point to go to, from `here`; `None` at the end. A point is passed within
    /// `arrival` m.
    pub(super) fn next(&mut self, here: Point, arrival: f64) -> Option<Point> {
        // Whatever lies behind a point that is near has been passed.
        let near = |(_, point): &(u32, Point)| (point - here).norm() <= arrival;
        if let Some(index) = self.ahead.iter().position(near) {
            self.passed = self.ahead[index].0;
            self.ahead.truncate(index);
        }
        self.ahead.last().map(|(_, point)| *point)
    }

    /// Returns the link in progress: the place that was passed last, and the next one.
    pub(super) fn link(&self) -> Option<(u32, u32)> {
        let (next, _) = self.ahead.last()?;
        Some((self.passed, *next))
    }
}
