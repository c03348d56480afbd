use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;
use crate::breadth_first::search;

/// A path of fewest arcs from `source` to a node that is a goal, both ends included; none where no way leads
/// to one. Breadth-first search; among equally short paths the one whose arcs the graph lists earlier.
/// O(nodes + arcs). Nodes the graph does not have are passed over.
#[must_use]
pub fn path_to(graph: &impl Graph, source: u32, is_goal: impl Fn(u32) -> bool) -> Option<Vec<u32>> {
    let (reached, goal) = search(graph, [source], is_goal);
    let came_from = |node: u32| reached[node as usize].map(|(_, before)| before);
    Some(trace_back(source, goal?, came_from))
}

/// The nodes from `source` to `goal`, by the node that each was reached from.
pub(crate) fn trace_back(
    source: u32,
    goal: u32,
    came_from: impl Fn(u32) -> Option<u32>,
) -> Vec<u32> {
    let mut path = vec![goal];
    let mut node = goal;
    while let Some(origin) = came_from(node).filter(|_| node != source) {
        path.push(origin);
        node = origin;
    }
    path.reverse();
    path
}
