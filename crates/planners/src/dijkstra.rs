use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

use crate::Graph;

/// For every node, the least sum of arc costs on a way to it from any of `sources`, or none where no way
/// leads. Dijkstra's algorithm with a binary heap, O(arcs · log nodes); ties go to the lower node id.
/// Sums that would exceed `u32::MAX` count as no way. Nodes the graph does not have,
/// as sources or at the end of an arc, are passed over.
#[must_use]
pub fn costs_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    let mut costs: Vec<Option<u32>> = vec![None; graph.node_count()];
    let mut frontier = BinaryHeap::new();
    for source in sources {
        if let Some(cost) = costs.get_mut(source as usize) {
            *cost = Some(0);
            frontier.push(Reverse((0, source)));
        }
    }
    while let Some(Reverse((cost, node))) = frontier.pop() {
        if costs[node as usize].is_some_and(|best| best < cost) {
            continue; // A cheaper way was found after this entry was queued.
        }
        graph.for_each_arc(node, |head, step| {
            let Some(reached) = cost.checked_add(step) else {
                return;
            };
            let Some(best) = costs.get_mut(head as usize) else {
                return;
            };
            if best.is_none_or(|best| reached < best) {
                *best = Some(reached);
                frontier.push(Reverse((reached, head)));
            }
        });
    }
    costs
}
