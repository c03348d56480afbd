use alloc::collections::VecDeque;
use alloc::vec;
use alloc::vec::Vec;

use super::graph::MslstGraph;
use super::graph_mapper::GraphMapper;
use super::localize::Localization;

/// Finds the node that fits the graph which the robot has built since it was put down.
///
/// The paper names this as its next step: "it could instead build up a new graph during navigation,
/// using the same techniques used to build the graph during Phase II, and overlay it on the
/// existing graph to find places that match."
///
/// The robot's node in `walked` is laid on each node with its state in turn, and the rest follows,
/// edge by edge. Edges match that have the same action and lead to the same state; failed actions
/// match failed actions. What lies beyond an edge that does not match counts for nothing. The
/// candidates are the nodes with the most matches, and [`Localization::matched`] is their number.
/// Ties go to the node with the shortest path to a destination node, then to the one made earlier.
/// O(nodes · size of `walked` · degree).
///
/// ```
/// use tolman_maps::mslst_graph::{GraphMapper, NodeZone::Elsewhere, overlay};
/// use tolman_maze::Direction::{East, North, West};
///
/// // A corridor of three nodes that look alike; only the middle one can be left to the north.
/// let mut mapper = GraphMapper::new(7, Elsewhere);
/// mapper.failed(North);
/// mapper.succeeded(East, 7, Elsewhere);
/// mapper.succeeded(North, 3, Elsewhere);
/// mapper.succeeded(North.opposite(), 7, Elsewhere);
/// mapper.succeeded(East, 7, Elsewhere);
/// mapper.failed(North);
/// let graph = mapper.finish();
///
/// // The robot cannot go north, so it is at one of the ends.
/// let mut walked = GraphMapper::new(7, Elsewhere);
/// walked.failed(North);
/// assert_eq!(overlay(&graph, &walked).candidates, [0, 3]);
/// // West of it the robot can, so it is at the east end.
/// walked.succeeded(West, 7, Elsewhere);
/// walked.succeeded(North, 3, Elsewhere);
/// walked.succeeded(North.opposite(), 7, Elsewhere);
/// walked.succeeded(East, 7, Elsewhere);
/// assert_eq!(overlay(&graph, &walked).candidates, [3]);
/// ```
#[must_use]
pub fn overlay(graph: &MslstGraph, walked: &GraphMapper) -> Localization {
    let Some(here) = walked.nodes().get(walked.at() as usize) else {
        return Localization::default();
    };
    let (mut candidates, mut most) = (Vec::new(), 0);
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if node.state != here.state {
            continue;
        }
        let matched = matches(graph, id, walked);
        if matched > most {
            candidates.clear();
            most = matched;
        }
        if matched == most {
            candidates.push(id);
        }
    }
    Localization::of(graph, candidates, most)
}

/// Returns the number of nodes and failed actions of `walked` that match if its node of the robot
/// is laid on node `id`.
fn matches(graph: &MslstGraph, id: u32, walked: &GraphMapper) -> usize {
    let nodes = walked.nodes();
    let mut is_laid = vec![false; nodes.len()];
    let mut reached = VecDeque::from([(walked.at(), id)]);
    is_laid[walked.at() as usize] = true;
    let mut matched = 1;
    while let Some((own, on)) = reached.pop_front() {
        let there = graph.node(on);
        for edge in &nodes[own as usize].edges {
            let Some(head) = edge.head else {
                matched += usize::from(there.is_some_and(|node| node.edges.contains(edge)));
                continue;
            };
            if is_laid[head as usize] {
                continue;
            }
            if let Some(next) = graph.follow(on, edge.action, nodes[head as usize].state) {
                is_laid[head as usize] = true;
                matched += 1;
                reached.push_back((head, next));
            }
        }
    }
    matched
}
