//! The map of a system as it grows.

use alloc::collections::{BTreeMap, BTreeSet};
use core::mem;

use tolman_arena::Outing;
use tolman_geom::Point;
use tolman_replay::{EdgeKind, Fact, MapEdge, MapGrowth, MapNode};
use tolman_robot::{Landmark, MapPlace, MapView};

use crate::swept_floor::SweptFloor;

/// Distance within which a node that moved is not redrawn, m.
const STILL: f64 = 0.05;

/// Records a map as it changes.
#[derive(Clone, Debug)]
pub(crate) struct Growth {
    nodes: Vec<MapNode>,
    /// Node of each place that was on the map.
    shown: BTreeMap<u32, usize>,
    edges: BTreeMap<(usize, usize), MapEdge>,
    /// Edges that ended before another one with the same ends began.
    gone: Vec<MapEdge>,
    /// Node that is labelled as the goal.
    goal: Option<usize>,
    /// Distance within which the robot passes a place, m.
    near: f64,
    floor: SweptFloor,
    /// Size of the floor when the edges were drawn last, cells.
    drawn_on: usize,
}

impl Growth {
    pub(crate) fn new(outing: &dyn Outing) -> Self {
        let near = 0.5 * outing.course().corridor_width;
        Self {
            nodes: Vec::new(),
            shown: BTreeMap::new(),
            edges: BTreeMap::new(),
            gone: Vec::new(),
            goal: None,
            near,
            floor: SweptFloor::new(outing, near),
            drawn_on: 0,
        }
    }

    /// Takes in that the robot truly is at a position.
    pub(crate) fn sweep(&mut self, position: Point) {
        self.floor.sweep(position);
    }

    /// Takes in that the robot was lifted.
    pub(crate) const fn lift(&mut self) {
        self.floor.lift();
    }

    /// Returns where a place was shown last.
    pub(crate) fn site(&self, place: u32) -> Option<Point> {
        let node = self.shown.get(&place)?;
        Some(self.nodes[*node].latest())
    }

    /// Records the map at a step. `at` gives the true position of a place.
    pub(crate) fn see(
        &mut self,
        step: u32,
        map: &MapView,
        at: impl Fn(&MapPlace) -> Option<Point>,
    ) {
        let placed: Vec<(MapPlace, Point)> = (map.places.iter())
            .filter_map(|place| Some((*place, at(place)?)))
            .collect();
        let moved = self.place(step, &placed);
        self.label(step, &placed);
        let node = |id: u32| self.shown.get(&id).copied();
        let wanted: BTreeSet<(usize, usize)> = (map.links.iter())
            .filter_map(|link| {
                let (a, b) = (node(link.from)?, node(link.to)?);
                let is_alive = |node: usize| self.nodes[node].died.is_none();
                (is_alive(a) && is_alive(b)).then_some((a.min(b), a.max(b)))
            })
            .collect();
        self.link(step, &wanted, &moved);
    }

    /// Shows the places at their positions, and returns the nodes that are new or have moved.
    fn place(&mut self, step: u32, placed: &[(MapPlace, Point)]) -> BTreeSet<usize> {
        let mut moved = BTreeSet::new();
        let mut there = BTreeSet::new();
        for (place, at) in placed {
            let known = self.shown.get(&place.id).copied();
            let node = match known.filter(|node| self.is_same(*node, place.id, *at, placed)) {
                Some(node) => {
                    let shown = &mut self.nodes[node];
                    let before = shown.latest();
                    shown.move_to(step, *at, STILL);
                    if shown.latest() != before {
                        moved.insert(node);
                    }
                    // A place that reappears was only out of sight.
                    shown.died = None;
                    node
                }
                None => {
                    let node = self.nodes.len();
                    let mut new = MapNode::new(node as u32, *at, step);
                    if new.id != place.id {
                        new.facts = vec![Fact::new("place", place.id.to_string())];
                    }
                    self.nodes.push(new);
                    moved.insert(node);
                    node
                }
            };
            self.shown.insert(place.id, node);
            there.insert(node);
        }
        for (number, node) in self.nodes.iter_mut().enumerate() {
            if node.died.is_none() && !there.contains(&number) {
                node.died = Some(step);
            }
        }
        moved
    }

    /// Returns whether a node still stands for the place `id`, which now is at `at`. Some systems
    /// give their places other numbers now and then: then another place lies where this one was.
    fn is_same(&self, node: usize, id: u32, at: Point, placed: &[(MapPlace, Point)]) -> bool {
        let before = self.nodes[node].latest();
        let moved = (at - before).norm();
        let is_nearer = |(other, position): &(MapPlace, Point)| {
            other.id != id && (position - before).norm() < moved
        };
        moved <= STILL || !placed.iter().any(is_nearer)
    }

    /// Labels the goal as long as the system knows it. Many places may be there; one is labelled.
    fn label(&mut self, step: u32, placed: &[(MapPlace, Point)]) {
        let goals = placed
            .iter()
            .filter(|(place, _)| place.landmark == Some(Landmark::Goal));
        let goals: Vec<usize> = goals.map(|(place, _)| self.shown[&place.id]).collect();
        let goal = self.goal.filter(|goal| goals.contains(goal));
        let goal = goal.or(goals.first().copied());
        if let Some(before) = mem::replace(&mut self.goal, goal) {
            self.nodes[before].label_from(step, "");
        }
        if let Some(goal) = goal {
            self.nodes[goal].label_from(step, "goal");
        }
    }

    /// Shows these edges along the ways that were driven, or else along the shortest ones. `moved`
    /// has the nodes that are new or have moved.
    fn link(&mut self, step: u32, wanted: &BTreeSet<(usize, usize)>, moved: &BTreeSet<usize>) {
        for (ends, edge) in &mut self.edges {
            if edge.died.is_none() && !wanted.contains(ends) {
                edge.died = Some(step);
            }
        }
        let floor_grew = self.floor.size() > mem::replace(&mut self.drawn_on, self.floor.size());
        for (a, b) in wanted {
            let before = self.edges.get(&(*a, *b));
            let holds = before.is_some_and(|edge| {
                let is_settled = edge.kind == EdgeKind::Passage || !floor_grew;
                let has_moved = moved.contains(a) || moved.contains(b);
                edge.died.is_none() && is_settled && !has_moved
            });
            if holds {
                continue;
            }
            let mut edge = MapEdge::new(*a as u32, *b as u32, step);
            match self.way(*a, *b) {
                Some(way) => edge.way = way,
                None => {
                    edge.kind = EdgeKind::Supposed;
                    let stays = before.filter(|before| {
                        before.kind == EdgeKind::Supposed
                            && !moved.contains(a)
                            && !moved.contains(b)
                    });
                    edge.way = match stays {
                        Some(before) => before.way.clone(),
                        None => {
                            let [a, b] = [a, b].map(|end| self.nodes[*end].latest());
                            self.floor.shortest(a, b)
                        }
                    };
                }
            }
            let is_new = before.is_none_or(|before| {
                before.died.is_some() || (before.kind, &before.way) != (edge.kind, &edge.way)
            });
            if is_new && let Some(mut before) = self.edges.insert((*a, *b), edge) {
                before.died.get_or_insert(step);
                if before.died > Some(before.born) {
                    self.gone.push(before);
                }
            }
        }
    }

    /// Returns the corners of the way between two nodes; `None` if the robot has not driven there,
    /// or by another place alone.
    fn way(&self, a: usize, b: usize) -> Option<Vec<Point>> {
        let ends = [a, b].map(|end| self.nodes[end].latest());
        let way = self.floor.way(ends[0], ends[1])?;
        let is_beside = |at: Point| ends.iter().all(|end| (at - end).norm() > 2.0 * self.near);
        let others = self.nodes.iter().filter(|node| node.died.is_none());
        let mut others = others.map(MapNode::latest).filter(|at| is_beside(*at));
        let line: Vec<Point> = [ends[0]]
            .into_iter()
            .chain(way.iter().copied())
            .chain([ends[1]])
            .collect();
        let passes = |at: Point| {
            let pieces = line.windows(2);
            pieces
                .map(|piece| distance(at, piece[0], piece[1]))
                .any(|far| far < 0.5 * self.near)
        };
        let is_straight = way.is_empty();
        (is_straight || !others.any(passes)).then_some(way)
    }

    /// Returns the positions of the places that the map has now.
    pub(crate) fn places(&self) -> Vec<Point> {
        let alive = self.nodes.iter().filter(|node| node.died.is_none());
        alive.map(MapNode::latest).collect()
    }

    /// Returns the pieces of the ways that the map has now.
    pub(crate) fn ways(&self) -> Vec<[Point; 2]> {
        let alive = self.edges.iter().filter(|(_, edge)| edge.died.is_none());
        let line = |((a, b), edge): (&(usize, usize), &MapEdge)| {
            let ends = [a, b].map(|end| self.nodes[*end].latest());
            let way = edge.way.iter().copied().chain([ends[1]]);
            way.scan(ends[0], |from, to| Some([mem::replace(from, to), to]))
                .collect::<Vec<_>>()
        };
        alive.flat_map(line).collect()
    }

    /// Returns the recorded map.
    pub(crate) fn recorded(self) -> MapGrowth {
        MapGrowth {
            name: "map".to_owned(),
            nodes: self.nodes,
            edges: self
                .gone
                .into_iter()
                .chain(self.edges.into_values())
                .collect(),
        }
    }
}

/// Returns the distance of a point from the line between two others, m.
fn distance(at: Point, a: Point, b: Point) -> f64 {
    let line = b - a;
    let along = (at - a).dot(&line) / line.norm_squared();
    let along = if along.is_finite() {
        along.clamp(0.0, 1.0)
    } else {
        0.0
    };
    (a + along * line - at).norm()
}
