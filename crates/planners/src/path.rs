use alloc::vec::Vec;

use crate::Graph;
use crate::breadth_first::search;

/// Returns a path of fewest arcs from `source` to a goal, both ends included, or `None` if no way
/// leads to one. Breadth-first search; of equally short paths the one whose arcs the graph lists
/// earlier. O(nodes + arcs). Nodes that the graph does not have are ignored.
#[must_use]
pub fn path_to(graph: &impl Graph, source: u32, is_goal: impl Fn(u32) -> bool) -> Option<Vec<u32>> {
    let (reached, goal) = search(graph, [source], is_goal);
    Some(trace_back(source, goal?, &reached))
}

/// Returns the nodes from `source` to `goal`, by the node that each was reached from.
pub(crate) fn trace_back(source: u32, goal: u32, reached: &[Option<(u32, u32)>]) -> Vec<u32> {
    let came_from = |node: &u32| reached[*node as usize].map(|(_, before)| before);
    let back = |node: &u32| came_from(node).filter(|_| *node != source);
    let mut path: Vec<u32> = core::iter::successors(Some(goal), back).collect();
    path.reverse();
    path
}
