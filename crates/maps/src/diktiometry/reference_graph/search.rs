use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::{Ordering, Reverse};

use tolman_geom::PointBox;

use super::ReferenceGraph;
use crate::diktiometry::config::SearchLimits;
use crate::diktiometry::ids::FrameId;

/// A frame that a search reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::diktiometry) struct Reached {
    pub(in crate::diktiometry) frame: FrameId,
    /// Its origin in the frame where the search began, m.
    pub(in crate::diktiometry) position: PointBox,
    /// Relations followed on the way.
    pub(in crate::diktiometry) hops: u32,
}

/// The frames around `start`, those of best known position first, `start` itself before all.
///
/// Dijkstra's algorithm on the width of the box; where several ways lead to a frame from frames reached before, its
/// position is what they all allow. O(frames · degree · log frames).
///
/// The paper searches the graph by plies and says that "the farther a frame is in the reference graph, the less useful
/// information (in general) it gives"; width is that information itself.
pub(in crate::diktiometry) fn search(
    graph: &ReferenceGraph,
    start: FrameId,
    limits: &SearchLimits,
) -> Vec<Reached> {
    let mut reached: Vec<Reached> = Vec::new();
    let mut ways = vec![Way::Unknown; graph.frames.len()];
    let mut frontier = BinaryHeap::new();
    frontier.push(Reverse(Entry {
        width: 0.0,
        frame: start,
        hops: 0,
    }));
    while let Some(Reverse(entry)) = frontier.pop() {
        if matches!(ways[entry.frame.index()], Way::Reached(_)) {
            continue; // It was reached by a narrower way.
        }
        let relations = &graph.frames[entry.frame.index()].relations;
        let positions = relations
            .iter()
            .filter_map(|relation| match ways[relation.to.index()] {
                Way::Reached(there) => Some(reached[there as usize].position - relation.position),
                Way::Unknown | Way::Seen(_) => None,
            });
        // Ways that exclude each other are told apart elsewhere; here the first counts.
        let both = |a: PointBox, b: PointBox| a.intersection(b).unwrap_or(a);
        let position = positions.reduce(both).unwrap_or(PointBox::ORIGIN);
        ways[entry.frame.index()] = Way::Reached(reached.len() as u32);
        reached.push(Reached {
            frame: entry.frame,
            position,
            hops: entry.hops,
        });
        if reached.len() >= limits.frames {
            break;
        }
        if entry.hops >= limits.depth {
            continue;
        }
        let (wide, high) = (position.x.width(), position.y.width());
        for relation in relations {
            // The order of the search needs no sound rounding.
            let there = relation.position;
            let width = (wide + there.x.width()).max(high + there.y.width());
            let way = &mut ways[relation.to.index()];
            let narrower = match *way {
                Way::Unknown => true,
                Way::Seen(least) => width < least,
                Way::Reached(_) => false,
            };
            if narrower && width <= limits.width {
                *way = Way::Seen(width);
                frontier.push(Reverse(Entry {
                    width,
                    frame: relation.to,
                    hops: entry.hops + 1,
                }));
            }
        }
    }
    reached
}

/// What a search knows of a frame.
#[derive(Clone, Copy)]
enum Way {
    Unknown,
    /// The width of the narrowest way so far, m.
    Seen(f64),
    /// Its number among those reached.
    Reached(u32),
}

/// A frame to be reached, ordered by the width of its box, then by id.
struct Entry {
    width: f64,
    frame: FrameId,
    hops: u32,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let width = self.width.total_cmp(&other.width);
        width
            .then(self.frame.cmp(&other.frame))
            .then(self.hops.cmp(&other.hops))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}
