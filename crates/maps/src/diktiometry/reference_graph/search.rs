use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

use tolman_geom::PointBox;

use super::ReferenceGraph;
use crate::diktiometry::{FrameId, SearchLimits};

/// A frame that a search reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reached {
    pub(crate) frame: FrameId,
    /// Position of the frame's origin in the frame where the search began, m.
    pub(crate) position: PointBox,
    /// Number of relations followed to the frame.
    pub(crate) hops: u32,
}

/// Returns the frames around `start` by rising uncertainty of their position, `start` itself first.
///
/// Dijkstra's algorithm on the width of the box. If several ways lead to a frame from frames
/// reached before, its box is their intersection. O(frames · degree · log frames).
///
/// The paper searches the graph by plies and says that "the farther a frame is in the reference
/// graph, the less useful information (in general) it gives". The width measures that information
/// itself.
pub(crate) fn search(
    graph: &ReferenceGraph,
    start: FrameId,
    limits: &SearchLimits,
) -> Vec<Reached> {
    let mut reached: Vec<Reached> = Vec::new();
    let mut ways = vec![Way::Unknown; graph.frames.len()];
    let mut frontier = BinaryHeap::from([Reverse((Width::of(0.0), start, 0))]);
    while let Some(Reverse((_, frame, hops))) = frontier.pop() {
        if matches!(ways[frame.index()], Way::Reached(_)) {
            continue; // It was reached by a narrower way.
        }
        let relations = graph.relations(frame);
        let positions = relations
            .clone()
            .filter_map(|relation| match ways[relation.to.index()] {
                Way::Reached(there) => Some(reached[there as usize].position - relation.position),
                Way::Unknown | Way::Seen(_) => None,
            });
        // Ways that exclude each other are told apart elsewhere; here the first counts.
        let both = |a: PointBox, b: PointBox| a.intersection(b).unwrap_or(a);
        let position = positions.reduce(both).unwrap_or(PointBox::ORIGIN);
        ways[frame.index()] = Way::Reached(reached.len() as u32);
        reached.push(Reached {
            frame,
            position,
            hops,
        });
        if reached.len() >= limits.frames {
            break;
        }
        if hops >= limits.depth {
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
                frontier.push(Reverse((Width::of(width), relation.to, hops + 1)));
            }
        }
    }
    reached
}

/// State of a frame in a search.
#[derive(Clone, Copy)]
enum Way {
    Unknown,
    /// Width of the narrowest way so far, m.
    Seen(f64),
    /// Number of the frame among those reached.
    Reached(u32),
}

/// Width as a whole number of the same order; widths are never negative.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Width(u64);

impl Width {
    const fn of(width: f64) -> Self {
        Self(width.abs().to_bits())
    }
}
