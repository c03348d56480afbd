use alloc::vec;
use alloc::vec::Vec;

use crate::Graph;

/// A graph stored as a list of arcs, grouped by the node they leave (compressed sparse rows).
///
/// ```
/// use tolman_planners::{Arcs, costs_from};
///
/// // From 0 to 1 for 5, and from 1 back to 0 for 7.
/// let arcs = Arcs::new(2, &[(0, 1, 5), (1, 0, 7)]);
/// assert_eq!(costs_from(&arcs, [0]), [Some(0), Some(5)]);
/// assert_eq!(costs_from(&arcs.reversed(), [0]), [Some(0), Some(7)]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arcs {
    /// Index in `arcs` of each node's first arc; one more entry than nodes.
    first: Vec<u32>,
    /// (head, cost) of every arc, by tail, then in the order given.
    arcs: Vec<(u32, u32)>,
}

impl Arcs {
    /// Returns the graph of `node_count` nodes with the arcs (tail, head, cost). O(nodes + arcs).
    ///
    /// Arcs that leave or reach a node the graph does not have are left out.
    #[must_use]
    pub fn new(node_count: usize, list: &[(u32, u32, u32)]) -> Self {
        let held = |&&(tail, head, _): &&(u32, u32, u32)| {
            (tail as usize) < node_count && (head as usize) < node_count
        };
        let mut first = vec![0_u32; node_count + 1];
        for &(tail, ..) in list.iter().filter(held) {
            first[tail as usize + 1] += 1;
        }
        for node in 0..node_count {
            first[node + 1] += first[node];
        }
        let mut next = first.clone();
        let mut arcs = vec![(0, 0); first[node_count] as usize];
        for &(tail, head, cost) in list.iter().filter(held) {
            let slot = &mut next[tail as usize];
            arcs[*slot as usize] = (head, cost);
            *slot += 1;
        }
        Self { first, arcs }
    }

    /// Returns the same graph with every arc reversed. O(nodes + arcs).
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut list = Vec::with_capacity(self.arcs.len());
        for tail in 0..self.node_count() as u32 {
            self.for_each_arc(tail, |head, cost| list.push((head, tail, cost)));
        }
        Self::new(self.node_count(), &list)
    }
}

impl Graph for Arcs {
    fn node_count(&self) -> usize {
        self.first.len() - 1
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let node = node as usize;
        let (Some(from), Some(to)) = (self.first.get(node), self.first.get(node + 1)) else {
            return;
        };
        for &(head, cost) in &self.arcs[*from as usize..*to as usize] {
            visit(head, cost);
        }
    }
}
