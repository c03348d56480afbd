use alloc::vec::Vec;

use crate::Graph;
use crate::reached::Reached;
use crate::ring::Ring;

/// Returns, for every node, the least sum of arc costs on a way to it from any of `sources`; `None`
/// if there is no way. Dijkstra's algorithm with buckets, O(nodes + arcs) for costs below 256 and
/// O(arcs · log nodes) for others. Sums that would exceed `u32::MAX` count as no way. Nodes that
/// the graph does not have are ignored.
#[must_use]
pub fn costs_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    let mut reached = Reached::new(graph.node_count());
    let mut frontier = Ring::new();
    for source in sources {
        if reached.improve(source, 0, source) {
            frontier.push(0, source);
        }
    }
    while let Some((cost, node)) = frontier.pop() {
        if reached.get(node).is_some_and(|(best, _)| best < cost) {
            continue; // A cheaper way was found after this entry was queued.
        }
        graph.for_each_arc(node, |head, step| {
            if let Some(cost) = cost.checked_add(step)
                && reached.improve(head, cost, node)
            {
                frontier.push(cost, head);
            }
        });
    }
    reached.costs()
}
