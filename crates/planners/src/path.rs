use alloc::vec::Vec;

use crate::Graph;
use crate::breadth_first::search;

/// Returns a path of fewest arcs from `source` to a goal, both ends included, or `None` if no way
/// leads to one. Breadth-first search; of equally short paths the one whose arcs the graph lists
/// earlier. O(nodes + arcs). Nodes that the graph does not have are ignored.
#[must_use]
pub fn path_to(graph: &impl Graph, source: u32, is_goal: impl Fn(u32) -> bool) -> Option<Vec<u32>> {
    let (reached, goal) = search(graph, [source], is_goal);
    Some(reached.trace_back(source, goal?))
}
