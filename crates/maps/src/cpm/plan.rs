use alloc::vec::Vec;

use tolman_planners::{Graph, a_star};

use super::map::{CpMap, End, Fragment, JunctionId, Port, PortState};
use super::turn::Turn;

/// A way through the map. In the words of section 4.3: "follow the path until reaching the
/// junction, perform Δ, follow the path by skipping the observation for 3 CPs until reaching
/// another junction, perform Δ, and make observation again to confirm the correct destination".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Fragments in order; empty if the robot is at the destination.
    pub legs: Vec<PlanLeg>,
    /// Sum of the lengths ℓ of all legs, observations.
    pub length: u32,
}

/// One fragment of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanLeg {
    /// Δ, performed before the leg.
    pub turn: Turn,
    /// Fragment, by the end at which the robot enters.
    pub enter: End,
    /// Port at which the leg arrives.
    pub arrive: Port,
    /// Number of observations along the fragment, "used to estimate how many observation the robot
    /// can skip"; 0 if it was too short for any.
    pub observations: u32,
}

impl CpMap {
    /// Returns the shortest known way, in observations, to the nearest junction for which `wanted`
    /// is true. The way begins at the port `from`. Returns `None` if no such way is known. Ties go
    /// to the older junctions and fragments. O(fragments · log fragments).
    #[must_use]
    pub fn plan(&self, from: Port, wanted: impl Fn(JunctionId) -> bool) -> Option<Plan> {
        let source = self.junctions.rank(from.junction)? as u32;
        let id = |node: u32| self.junctions.id(node as usize);
        let found = a_star(self, source, |node| id(node).is_some_and(&wanted), |_| 0)?;
        let mut legs = Vec::new();
        let mut at = from;
        for node in found.path.iter().skip(1) {
            let enter = self.shortest_to(at.junction, id(*node)?)?;
            let fragment = self.fragment(enter.fragment)?;
            let (leave, arrive) = (
                fragment.port(enter.sign),
                fragment.port(enter.opposite().sign),
            );
            let degree = self.junction(at.junction)?.degree();
            legs.push(PlanLeg {
                turn: Turn::between(at.number, leave.number, degree).ok()?,
                enter,
                arrive,
                observations: fragment.patterns.len() as u32,
            });
            at = arrive;
        }
        let length = found.cost;
        Some(Plan { legs, length })
    }

    /// Returns the shortest of the fragments from one junction to another, by the end at which it
    /// is entered.
    fn shortest_to(&self, from: JunctionId, to: JunctionId) -> Option<End> {
        let ports = 0..self.junction(from)?.degree();
        let ends = ports.filter_map(|number| {
            let port = from.port(number);
            (self.beyond(port)?.junction == to).then(|| self.end_at(port))?
        });
        ends.min_by_key(|end| {
            let length = self.fragment(end.fragment).map(Fragment::length);
            (length, *end)
        })
    }
}

/// Graph of the map for planners: junctions by their rank, fragments by their length.
impl Graph for CpMap {
    fn node_count(&self) -> usize {
        self.junctions.len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for port in self.ports_at(node as usize) {
            if let PortState::Filled(end) = port
                && let Some(fragment) = self.fragment(end.fragment)
                && let Some((head, _)) = self.led_to(*port)
            {
                visit(head as u32, fragment.length());
            }
        }
    }
}
