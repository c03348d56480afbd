use alloc::vec::Vec;

use crate::Graph;
use crate::reached::Reached;
use crate::ring::Ring;

/// Returns the nodes of a cheapest path from `source` to `target`, both ends included, and its
/// cost; `None` if no way leads there. Dijkstra's algorithm from both ends at once, which expands
/// far fewer nodes than from one where neighbourhoods grow fast.
///
/// `reversed` is the same graph with every arc reversed: the graph itself if each arc leads both
/// ways. Sums that would exceed `u32::MAX` count as no way.
///
/// ```
/// use tolman_planners::{Arcs, path_between};
///
/// let arcs = Arcs::new(3, &[(0, 1, 2), (1, 2, 2), (0, 2, 9)]);
/// let found = path_between(&arcs, &arcs.reversed(), 0, 2);
/// assert_eq!(found, Some((vec![0, 1, 2], 4)));
/// ```
#[must_use]
pub fn path_between(
    graph: &impl Graph,
    reversed: &impl Graph,
    source: u32,
    target: u32,
) -> Option<(Vec<u32>, u32)> {
    let mut ahead = Half::new(graph.node_count(), source)?;
    let mut back = Half::new(reversed.node_count(), target)?;
    let mut best = (source == target).then_some((0, source));
    loop {
        let goes_on = match ahead.queued <= back.queued {
            true => ahead.expand(graph, &back, &mut best),
            false => back.expand(reversed, &ahead, &mut best),
        };
        if !goes_on {
            break;
        }
    }
    let (cost, middle) = best?;
    let mut path = ahead.reached.trace_back(source, middle);
    let rest = back.reached.trace_back(target, middle);
    path.extend(rest.iter().rev().skip(1));
    Some((path, cost))
}

/// The search from one end.
struct Half {
    reached: Reached,
    frontier: Ring,
    queued: usize,
}

impl Half {
    fn new(node_count: usize, end: u32) -> Option<Self> {
        let mut half = Self {
            reached: Reached::new(node_count),
            frontier: Ring::new(),
            queued: 1,
        };
        half.frontier.push(0, end);
        half.reached.improve(end, 0, end).then_some(half)
    }

    /// Expands a node, and keeps the cheapest way over a node that both ends have reached. Returns
    /// false if no cheaper one can be found.
    fn expand(&mut self, graph: &impl Graph, other: &Self, best: &mut Option<(u32, u32)>) -> bool {
        // If one end has seen all that it can reach, it has also seen the other end, or never will.
        let (Some((cost, node)), Some(rest)) = (self.frontier.pop(), other.frontier.least()) else {
            return false;
        };
        self.queued -= 1;
        if best.is_some_and(|(best, _)| best <= cost.saturating_add(rest)) {
            return false;
        }
        if self.reached.get(node).is_some_and(|(best, _)| best < cost) {
            return true; // A cheaper way was found after this entry was queued.
        }
        graph.for_each_arc(node, |head, step| {
            let Some(cost) = cost.checked_add(step) else {
                return;
            };
            if !self.reached.improve(head, cost, node) {
                return;
            }
            self.frontier.push(cost, head);
            self.queued += 1;
            let there = other.reached.get(head);
            if let Some(whole) = there.and_then(|(rest, _)| cost.checked_add(rest))
                && best.is_none_or(|(best, _)| whole < best)
            {
                *best = Some((whole, head));
            }
        });
        true
    }
}
