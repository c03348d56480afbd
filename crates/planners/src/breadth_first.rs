use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;

/// For every node, the least number of arcs that lead to it from any of `sources`, or none where no way
/// leads. Breadth-first search, O(nodes + arcs). Nodes the graph does not have, as sources or at
/// the end of an arc, are passed over.
#[must_use]
pub fn steps_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    let mut steps = vec![None; graph.node_count()];
    let mut frontier = Vec::new();
    for source in sources {
        if let Some(step @ None) = steps.get_mut(source as usize) {
            *step = Some(0);
            frontier.push(source);
        }
    }
    let mut depth = 0;
    while !frontier.is_empty() {
        depth += 1;
        let mut next = Vec::new();
        for node in frontier {
            graph.for_each_arc(node, |head, _| {
                if let Some(step @ None) = steps.get_mut(head as usize) {
                    *step = Some(depth);
                    next.push(head);
                }
            });
        }
        frontier = next;
    }
    steps
}
