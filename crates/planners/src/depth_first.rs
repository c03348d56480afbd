use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;
use crate::best_first::Found;
use crate::reached::Reached;

/// Returns some path from `source` to a goal, or `None` if no way leads to one. Depth-first search:
/// it goes on from the node that it reached last, along the arcs in their order, and back where no
/// new node is left. The path may be far from the cheapest. O(arcs).
///
/// ```
/// use tolman_planners::{Arcs, depth_first};
///
/// // It follows its first arc to node 1, and on from there, although node 2 is beside the goal.
/// let arcs = Arcs::new(4, &[(0, 1, 1), (1, 3, 5), (0, 2, 2), (2, 3, 2)]);
/// let found = depth_first(&arcs, 0, |node| node == 3).unwrap();
/// assert_eq!((found.path.as_slice(), found.cost, found.expanded), ([0, 1, 3].as_slice(), 6, 2));
/// ```
#[must_use]
pub fn depth_first(
    graph: &impl Graph,
    source: u32,
    is_goal: impl Fn(u32) -> bool,
) -> Option<Found> {
    let mut reached = Reached::new(graph.node_count());
    let mut expanded = 0;
    // Arcs to follow, the next one last: the node at the head, the cost of the way, and the tail.
    let mut open = vec![(source, 0, source)];
    while let Some((node, cost, from)) = open.pop() {
        if reached.get(node).is_some() || !reached.improve(node, cost, from) {
            continue;
        }
        if is_goal(node) {
            return Some(Found {
                path: reached.trace_back(source, node),
                cost,
                expanded,
            });
        }
        expanded += 1;
        let mut ahead = Vec::new();
        graph.for_each_arc(node, |head, step| {
            ahead.extend(cost.checked_add(step).map(|cost| (head, cost, node)));
        });
        open.extend(ahead.into_iter().rev());
    }
    None
}
