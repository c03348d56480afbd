use alloc::vec::Vec;

use crate::Graph;
use crate::reached::Reached;

/// Returns, for every node, the least number of arcs that lead to it from any of `sources`, or
/// `None` if no way leads there. Breadth-first search, O(nodes + arcs). Nodes that the graph does
/// not have are ignored.
#[must_use]
pub fn steps_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    search(graph, sources, |_| false).0.costs()
}

/// Returns, for every node, the number of arcs to it and the node before it, as far as they are
/// known at the first goal. That goal is returned as well.
pub(crate) fn search(
    graph: &impl Graph,
    sources: impl IntoIterator<Item = u32>,
    is_goal: impl Fn(u32) -> bool,
) -> (Reached, Option<u32>) {
    let mut reached = Reached::new(graph.node_count());
    let mut queue = Vec::new();
    for source in sources {
        if reached.improve(source, 0, source) {
            queue.push((source, 0));
        }
    }
    let mut next = 0;
    while let Some(&(node, steps)) = queue.get(next) {
        next += 1;
        if is_goal(node) {
            return (reached, Some(node));
        }
        // Who was reached before was reached by as few steps.
        graph.for_each_arc(node, |head, _| {
            if reached.improve(head, steps + 1, node) {
                queue.push((head, steps + 1));
            }
        });
    }
    (reached, None)
}
