use alloc::vec::Vec;

use crate::Graph;
use crate::best_first::search;

/// Returns, for every node, the least sum of arc costs on a way to it from any of `sources`; `None`
/// if there is no way. Dijkstra's algorithm with a binary heap, O(arcs · log nodes); ties go to the
/// lower node id. Sums that would exceed `u32::MAX` count as no way. Nodes that the graph does not
/// have are ignored.
#[must_use]
pub fn costs_from(graph: &impl Graph, sources: impl IntoIterator<Item = u32>) -> Vec<Option<u32>> {
    let searched = search(graph, sources, |_| false, |_, cost| (cost, 0));
    let reached = searched.reached.into_iter();
    reached.map(|reached| Some(reached?.0)).collect()
}
