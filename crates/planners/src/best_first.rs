use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Reverse;

use crate::Graph;
use crate::reached::Reached;

/// A path to a goal, and the effort of finding it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Nodes from the source to a goal, both ends included.
    pub path: Vec<u32>,
    /// The sum of the arc costs along the path.
    pub cost: u32,
    /// Number of nodes whose arcs were listed.
    pub expanded: u32,
}

/// Returns the cheapest path from `source` to a goal, or `None` where no way leads to one: A*
/// (Hart, Nilsson, Raphael 1968).
///
/// `heuristic` estimates the cost from a node to the nearest goal. If it is admissible (never too
/// high), the path is a cheapest one; the tighter it is, the fewer nodes are expanded. With a
/// heuristic of 0 this is Dijkstra's algorithm. Ties go to the node with the lower estimate, then
/// to the lower id. O(arcs · log arcs) if the heuristic is consistent: it falls along no arc by
/// more than the arc costs.
///
/// ```
/// use tolman_planners::{Arcs, a_star};
///
/// let arcs = Arcs::new(4, &[(0, 1, 1), (1, 3, 5), (0, 2, 2), (2, 3, 2)]);
/// let guess = |node: u32| if node == 3 { 0 } else { 2 };
/// let found = a_star(&arcs, 0, |node| node == 3, guess).unwrap();
/// assert_eq!((found.path.as_slice(), found.cost), ([0, 2, 3].as_slice(), 4));
/// ```
#[must_use]
pub fn a_star(
    graph: &impl Graph,
    source: u32,
    is_goal: impl Fn(u32) -> bool,
    heuristic: impl Fn(u32) -> u32,
) -> Option<Found> {
    search(graph, source, is_goal, |node, cost| {
        let guess = heuristic(node);
        (cost.saturating_add(guess), guess)
    })
}

/// Returns some path from `source` to a goal, or `None` if no way leads to one. Greedy best-first
/// search: it always continues from the node that `heuristic` puts nearest to a goal, whatever the
/// cost so far. O(arcs · log arcs).
///
/// ```
/// use tolman_planners::{Arcs, best_first};
///
/// // It follows the promising node 1 and misses the cheaper way over 2.
/// let arcs = Arcs::new(4, &[(0, 1, 1), (1, 3, 5), (0, 2, 2), (2, 3, 2)]);
/// let guess = |node: u32| [9, 1, 2, 0][node as usize];
/// let found = best_first(&arcs, 0, |node| node == 3, guess).unwrap();
/// assert_eq!((found.cost, found.expanded), (6, 2));
/// ```
#[must_use]
pub fn best_first(
    graph: &impl Graph,
    source: u32,
    is_goal: impl Fn(u32) -> bool,
    heuristic: impl Fn(u32) -> u32,
) -> Option<Found> {
    search(graph, source, is_goal, |node, _| (heuristic(node), 0))
}

/// Expands the node of least `priority`, which is given a node and the cost of the way to it, until
/// it is a goal.
fn search(
    graph: &impl Graph,
    source: u32,
    is_goal: impl Fn(u32) -> bool,
    priority: impl Fn(u32, u32) -> (u32, u32),
) -> Option<Found> {
    let mut reached = Reached::new(graph.node_count());
    let mut expanded = 0;
    let mut frontier = BinaryHeap::new();
    if reached.improve(source, 0, source) {
        frontier.push(Reverse((priority(source, 0), source, 0)));
    }
    while let Some(Reverse((_, node, cost))) = frontier.pop() {
        if reached.get(node).is_some_and(|(best, _)| best < cost) {
            continue; // A cheaper way was found after this entry was queued.
        }
        if is_goal(node) {
            return Some(Found {
                path: reached.trace_back(source, node),
                cost,
                expanded,
            });
        }
        expanded += 1;
        graph.for_each_arc(node, |head, step| {
            if let Some(cost) = cost.checked_add(step)
                && reached.improve(head, cost, node)
            {
                frontier.push(Reverse((priority(head, cost), head, cost)));
            }
        });
    }
    None
}
