//! Where an unknown port may shorten a way that is known.

use alloc::vec;
use alloc::vec::Vec;

use tolman_planners::{Graph, a_star};

use super::map::{CpMap, JunctionId, Port, PortState};

impl CpMap {
    /// Returns the junction with an unknown port by which the way from a port to the nearest
    /// `wanted` junction is shortest if that port leads straight there; `None` if the known way is
    /// as short, or there is none, or no dead reckoning. O(fragments · log fragments).
    ///
    /// The paper's robot tries every port whose fragment may be shorter than the way it knows
    /// (section 6). Here the fragment is as long at least as the two places are apart by dead
    /// reckoning: the free-space assumption of A. Stentz, "Optimal and Efficient Path Planning for
    /// Partially-Known Environments", ICRA 1994.
    #[must_use]
    pub fn detour(&self, from: Port, wanted: impl Fn(JunctionId) -> bool) -> Option<JunctionId> {
        let source = self.junctions.rank(from.junction)? as u32;
        let hopes = self.hopes(&wanted)?;
        let there = hopes.len() as u32;
        let id = |node: u32| self.junctions.id(node as usize);
        let is_goal = |node| node == there || id(node).is_some_and(&wanted);
        let found = a_star(&Hopeful { map: self, hopes }, source, is_goal, |_| 0)?;
        let [.., before, last] = found.path[..] else {
            return None;
        };
        (last == there).then(|| id(before))?
    }

    /// Returns the least length of the way from each junction to the nearest `wanted` one by an
    /// unknown port, observations, by rank; `None` without unknown ports. Returns `None` if nothing
    /// is known of lengths.
    fn hopes(&self, wanted: impl Fn(JunctionId) -> bool) -> Option<Vec<Option<u32>>> {
        let lengths = self.fragments().filter_map(|(_, fragment)| {
            let metres = fragment.motion?.displacement.middle().coords.norm();
            Some((f64::from(fragment.length()), metres))
        });
        let (observations, metres) =
            lengths.fold((0.0, 0.0), |all, one| (all.0 + one.0, all.1 + one.1));
        let density = (metres > 0.0).then_some(observations / metres)?;
        let mut hopes = vec![None; self.junctions.len()];
        for (goal, _) in self.junctions().filter(|(id, _)| wanted(*id)) {
            for (rank, position) in self.positions_from(goal).iter().enumerate() {
                let open = self.ports_at(rank).iter().filter_map(|port| match port {
                    PortState::Open { at_least } => Some(*at_least),
                    _ => None,
                });
                if let (Some(position), Some(at_least)) = (position, open.min()) {
                    let apart = density * position.middle().coords.norm();
                    let hope = (apart as u32).max(at_least).max(1);
                    hopes[rank] = Some(hopes[rank].map_or(hope, |other: u32| other.min(hope)));
                }
            }
        }
        Some(hopes)
    }
}

/// The fragments of a map, and one from each junction with unknown ports to a node of its own, the
/// last.
struct Hopeful<'a> {
    map: &'a CpMap,
    /// Lengths of those, by the rank of the junction.
    hopes: Vec<Option<u32>>,
}

impl Graph for Hopeful<'_> {
    fn node_count(&self) -> usize {
        self.hopes.len() + 1
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let Some(hope) = self.hopes.get(node as usize) else {
            return;
        };
        self.map.for_each_arc(node, &mut visit);
        if let Some(hope) = hope {
            visit(self.hopes.len() as u32, *hope);
        }
    }
}
