use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;

/// Returns, for every node, the least number of arcs that lead to it from any of `sources`, or
/// `None` if no way leads there. Breadth-first search, O(nodes + arcs). Nodes that the graph does
/// not have are ignored.
#[must_use]
pub fn steps_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    let (reached, _) = search(graph, sources, |_| false);
    reached
        .into_iter()
        .map(|reached| Some(reached?.0))
        .collect()
}

/// Returns, for every node, the number of arcs to it and the node before it, as far as they are
/// known at the first goal. That goal is returned as well. A source comes from itself.
pub(crate) fn search(
    graph: &impl Graph,
    sources: impl IntoIterator<Item = u32>,
    is_goal: impl Fn(u32) -> bool,
) -> (Vec<Option<(u32, u32)>>, Option<u32>) {
    let mut reached: Vec<Option<(u32, u32)>> = vec![None; graph.node_count()];
    let mut queue = Vec::new();
    for source in sources {
        if let Some(slot @ None) = reached.get_mut(source as usize) {
            *slot = Some((0, source));
            queue.push((source, 0));
        }
    }
    let mut next = 0;
    while let Some(&(node, steps)) = queue.get(next) {
        next += 1;
        if is_goal(node) {
            return (reached, Some(node));
        }
        graph.for_each_arc(node, |head, _| {
            if let Some(slot @ None) = reached.get_mut(head as usize) {
                *slot = Some((steps + 1, node));
                queue.push((head, steps + 1));
            }
        });
    }
    (reached, None)
}
