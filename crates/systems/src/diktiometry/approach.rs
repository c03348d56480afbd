//! Plans to a place as if every way that was never tried led straight there.
//!
//! So a robot with errands tries a way where it may pay, and each way once: the detour that an
//! opportunity is worth (Engelson and McDermott, "Opportunities"), weighed by the free-space
//! assumption of A. Stentz, "Optimal and Efficient Path Planning for Partially-Known Environments",
//! ICRA 1994.

use tolman_control::heading_of;
use tolman_maps::diktiometry::{Action, Link, LinkId, Observer, PlaceId};
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

/// Returns the shortest way from one place to another, along ways that are known or hoped for, but
/// not along those that the rover sees to be shut at its place; `None` if there is none. O(places +
/// links · (degree + log links)).
pub(super) fn approach(
    observer: &Observer,
    exits: &[bool; 4],
    from: PlaceId,
    to: PlaceId,
) -> Option<Approach> {
    let paths = &observer.map().paths;
    let (from, to) = (paths.resolve(from)?, paths.resolve(to)?);
    let ways = HopefulWays {
        observer,
        exits,
        to,
    };
    let there = ways.hope_node();
    let found = a_star(&ways, from.0, |node| node == to.0 || node == there, |_| 0)?;
    let first = match found.path.get(1) {
        None => None,
        Some(node) if *node == there => ways.best_hope(from).map(|(way, _)| way),
        Some(node) => {
            let mut links = ways.open(from);
            let next = links.find(|(_, link)| link.to.0 == *node);
            next.and_then(|(_, link)| way_of(link.action))
        }
    };
    let metres = f64::from(found.cost) / MILLIMETRES;
    Some(Approach { first, metres })
}

/// The ways of a map, and one from each place with untried ways to a node that stands for `to`.
struct HopefulWays<'a> {
    observer: &'a Observer,
    exits: &'a [bool; 4],
    to: PlaceId,
}

/// A cost, per m.
const MILLIMETRES: f64 = 1000.0;

impl HopefulWays<'_> {
    /// Returns the node at the end of every hoped for way.
    fn hope_node(&self) -> u32 {
        self.observer.map().node_count() as u32
    }

    /// Returns the links that lead on from a place.
    fn open(&self, place: PlaceId) -> impl Iterator<Item = (LinkId, &Link)> {
        let is_here = place == self.observer.place();
        let links = self.observer.map().paths.likely(place);
        links.filter(move |(_, link)| {
            let way = way_of(link.action);
            !is_here || way.is_none_or(|way| self.exits[way.index()])
        })
    }

    /// Returns the untried way at a place by which the goal may be nearest, and how far it is at
    /// least: along corridors, the first of which is as long as two places are apart.
    fn best_hope(&self, place: PlaceId) -> Option<(Direction, f64)> {
        let untried = self.observer.untried(place);
        // The search below is the dear part.
        if untried.is_empty() {
            return None;
        }
        let (map, config) = (self.observer.map(), self.observer.config());
        let there = map.displacement(place, self.to, &config.search);
        let (there, least) = (there?.middle().coords, config.separation);
        let hopes = untried.into_iter().filter_map(way_of).map(|way| {
            let left = there - least * heading_of(way).unit();
            (way, least + left.x.abs() + left.y.abs())
        });
        hopes.min_by(|(_, one), (_, other)| one.total_cmp(other))
    }
}

fn way_of(Action(action): Action) -> Option<Direction> {
    Direction::ALL.get(action as usize).copied()
}

impl Graph for HopefulWays<'_> {
    fn node_count(&self) -> usize {
        self.observer.map().node_count() + 1
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        if node == self.hope_node() {
            return;
        }
        for (id, link) in self.open(PlaceId(node)) {
            visit(link.to.0, self.observer.map().cost(id, link));
        }
        if let Some((_, metres)) = self.best_hope(PlaceId(node)) {
            visit(self.hope_node(), (MILLIMETRES * metres) as u32);
        }
    }
}
