use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use super::{PlaneMaze, WorldPort};
use tolman_maps::cpm::{CpMap, JunctionId, Port};

/// Comparison of a map with the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MapCheck {
    /// The map is the world: each place and corridor once, all ports in order.
    Right,
    /// Everything on the map is right and there once; some corridors are missing.
    Partial,
    /// Everything on the map is right, but some things are there more than once.
    Redundant,
    /// Some way of the map leads to another place than in the world.
    Wrong,
}

impl PlaneMaze {
    /// Compares a map with this world, given the robot's position on both. Only corridors that can
    /// be reached count. O(fragments · log fragments).
    #[must_use]
    pub(crate) fn check(&self, map: &CpMap, at: Port, truly_at: WorldPort) -> MapCheck {
        let Some(known) = self.correspondence(map, at, truly_at) else {
            return MapCheck::Wrong;
        };
        let mut places: Vec<u32> = known.values().map(|port| port.place).collect();
        places.sort_unstable();
        places.dedup();
        if places.len() < known.len() || known.len() < map.junctions().len() {
            MapCheck::Redundant
        } else if map.is_explored() {
            MapCheck::Right
        } else {
            MapCheck::Partial
        }
    }

    /// Returns, for each junction to which the map has ways, the port of this world that is its
    /// port 0. The robot's place on both is given. `None` if the map is wrong somewhere.
    /// O(fragments · log fragments).
    #[must_use]
    pub(crate) fn correspondence(
        &self,
        map: &CpMap,
        at: Port,
        truly_at: WorldPort,
    ) -> Option<BTreeMap<JunctionId, WorldPort>> {
        let mut known: BTreeMap<JunctionId, WorldPort> = BTreeMap::new();
        let mut queue = vec![(at, truly_at)];
        while let Some((port, truth)) = queue.pop() {
            let degree = self.sighting(truth.place).degree;
            if map.junction(port.junction)?.sighting() != self.sighting(truth.place) {
                return None;
            }
            let first = WorldPort {
                place: truth.place,
                number: (truth.number + degree - port.number % degree) % degree,
            };
            if let Some(before) = known.insert(port.junction, first) {
                if before != first {
                    return None;
                }
                continue;
            }
            for number in 0..degree {
                let here = port.junction.port(number);
                let there = WorldPort {
                    number: (first.number + number) % degree,
                    ..first
                };
                if let (Some(next), Some(truth)) = (map.beyond(here), self.beyond(there)) {
                    queue.push((next, truth));
                }
            }
        }
        Some(known)
    }
}
