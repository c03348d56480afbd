use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;

/// A path of fewest arcs from `source` to a node that is a goal, both ends included; none where no way leads
/// to one. Breadth-first search; among equally short paths the one whose arcs the graph lists earlier.
/// O(nodes + arcs). Nodes the graph does not have are passed over.
#[must_use]
pub fn path_to(graph: &impl Graph, source: u32, is_goal: impl Fn(u32) -> bool) -> Option<Vec<u32>> {
    let mut came_from: Vec<Option<u32>> = vec![None; graph.node_count()];
    // The source comes from itself: it is reached, and the way back ends there.
    *came_from.get_mut(source as usize)? = Some(source);
    let mut queue = vec![source];
    let mut next = 0;
    while let Some(&node) = queue.get(next) {
        next += 1;
        if is_goal(node) {
            return Some(trace_back(source, node, |node| came_from[node as usize]));
        }
        graph.for_each_arc(node, |head, _| {
            if let Some(origin @ None) = came_from.get_mut(head as usize) {
                *origin = Some(node);
                queue.push(head);
            }
        });
    }
    None
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
