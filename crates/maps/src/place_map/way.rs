use alloc::vec::Vec;

use tolman_planners::{Arcs, a_star};
use tolman_quantizers::UnitId;

use super::PlaceMap;

/// Cost of a link of unknown length, mm.
const UNKNOWN_LENGTH: u32 = 1000;

impl PlaceMap {
    /// Returns the shortest way between two nodes along links, both ends included. `None` if no
    /// links lead there, or a node does not exist. A link's length is the distance of its nodes, to
    /// the millimetre. If odometry is not a chosen feature, all links are equally long.
    ///
    /// Dijkstra's algorithm, O(links log nodes).
    #[must_use]
    pub fn way(&self, from: UnitId, to: UnitId) -> Option<Vec<UnitId>> {
        let nodes: Vec<UnitId> = self.network().ids().collect();
        let index = |node: UnitId| nodes.binary_search(&node).ok().map(|index| index as u32);
        let arcs: Vec<(u32, u32, u32)> = self
            .network()
            .edges()
            .filter_map(|edge| {
                let (a, b) = (index(edge.ends.0)?, index(edge.ends.1)?);
                let length = self.length(edge.ends.0, edge.ends.1);
                Some([(a, b, length), (b, a, length)])
            })
            .flatten()
            .collect();
        let (source, goal) = (index(from)?, index(to)?);
        let graph = Arcs::new(nodes.len(), &arcs);
        let found = a_star(&graph, source, |node| node == goal, |_| 0)?;
        Some(
            found
                .path
                .iter()
                .map(|index| nodes[*index as usize])
                .collect(),
        )
    }

    /// Returns the distance between two nodes, mm.
    fn length(&self, a: UnitId, b: UnitId) -> u32 {
        match (self.position(a), self.position(b)) {
            (Some(a), Some(b)) => libm::round(1000.0 * (b - a).norm()) as u32,
            _ => UNKNOWN_LENGTH,
        }
    }
}
