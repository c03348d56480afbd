//! Plans to a place as if every way that was never tried led straight there.
//!
//! So a robot with errands tries a way where it may pay, and each way once: the detour that an
//! opportunity is worth (Engelson and McDermott, "Opportunities"), weighed by the free-space
//! assumption of A. Stentz, "Optimal and Efficient Path Planning for Partially-Known Environments",
//! ICRA 1994.

use tolman_control::heading_of;
use tolman_maps::diktiometry::{Action, Observer, PlaceId};
use tolman_maze::Direction;
use tolman_planners::{Graph, a_star};

/// Way to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Approach {
    /// Direction of the first move; `None` at the place.
    pub(super) first: Option<Direction>,
    /// Length if the hopes come true, m.
    pub(super) metres: f64,
}

/// Returns the shortest way from one place to another, along ways that are known or hoped for;
/// `None` if there is none. O(places + links · (degree + log links)).
pub(super) fn approach(observer: &Observer, from: PlaceId, to: PlaceId) -> Option<Approach> {
    let paths = &observer.map().paths;
    let (from, to) = (paths.resolve(from)?, paths.resolve(to)?);
    let ways = HopefulWays { observer, to };
    let there = ways.hope_node();
    let found = a_star(&ways, from.0, |node| node == to.0 || node == there, |_| 0)?;
    let first = match found.path.get(1) {
        None => None,
        Some(node) if *node == there => ways.best_hope(from).map(|(way, _)| way),
        Some(node) => paths.likely(from).find_map(|(_, link)| {
            let Action(action) = link.action;
            (link.to.0 == *node).then_some(*Direction::ALL.get(action as usize)?)
        }),
    };
    let metres = f64::from(found.cost) / MILLIMETRES;
    Some(Approach { first, metres })
}

/// The ways of a map, and one from each place with untried ways to a node that stands for `to`.
struct HopefulWays<'a> {
    observer: &'a Observer,
    to: PlaceId,
}

/// A cost, per m.
const MILLIMETRES: f64 = 1000.0;

impl HopefulWays<'_> {
    /// Returns the node at the end of every hoped for way.
    fn hope_node(&self) -> u32 {
        self.observer.map().node_count() as u32
    }

    /// Returns the untried way at a place by which the goal may be nearest, and how far it is at
    /// least: along corridors, the first of which is as long as two places are apart.
    fn best_hope(&self, place: PlaceId) -> Option<(Direction, f64)> {
        let config = self.observer.config();
        let there = self
            .observer
            .map()
            .displacement(place, self.to, &config.search);
        let (there, least) = (there?.middle().coords, config.separation);
        let untried = self.observer.untried(place).into_iter();
        let ways = untried.filter_map(|Action(action)| Direction::ALL.get(action as usize));
        let hopes = ways.map(|way| {
            let left = there - least * heading_of(*way).unit();
            (*way, least + left.x.abs() + left.y.abs())
        });
        hopes.min_by(|(_, one), (_, other)| one.total_cmp(other))
    }
}

impl Graph for HopefulWays<'_> {
    fn node_count(&self) -> usize {
        self.observer.map().node_count() + 1
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        if node == self.hope_node() {
            return;
        }
        self.observer.map().for_each_arc(node, &mut visit);
        if let Some((_, metres)) = self.best_hope(PlaceId(node)) {
            visit(self.hope_node(), (MILLIMETRES * metres) as u32);
        }
    }
}
