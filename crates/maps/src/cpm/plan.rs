use alloc::vec::Vec;

use tolman_planners::{Graph, a_star};

use super::map::{CpMap, End, Fragment, JunctionId, Port};
use super::turn::Turn;

/// A way through the map, as section 4.3 words it: "follow the path until reaching the junction, perform Δ, follow the
/// path by skipping the observation for 3 CPs until reaching another junction, perform Δ, and make observation again to
/// confirm the correct destination".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// One fragment after the other; none where the robot is there already.
    pub legs: Vec<PlanLeg>,
    /// ℓ of all of them together: observations.
    pub length: u32,
}

/// One fragment of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanLeg {
    /// Δ, to perform first.
    pub turn: Turn,
    /// The fragment, by the end to enter it at.
    pub enter: End,
    /// Where it leads.
    pub arrive: Port,
    /// How many observations were made along the fragment, "used to estimate how many observation the robot can skip"; 0 where
    /// it was too short for any.
    pub observations: u32,
}

impl CpMap {
    /// The shortest known way, in observations, from a robot's place to the nearest junction that is wanted; none if
    /// none is known. Ties go to the older junctions and fragments. O(fragments · log fragments).
    #[must_use]
    pub fn plan(&self, from: Port, wanted: impl Fn(JunctionId) -> bool) -> Option<Plan> {
        let view = View::of(self);
        let source = view.index(from.junction)?;
        let is_goal = |node: u32| {
            view.junctions
                .get(node as usize)
                .is_some_and(|id| wanted(*id))
        };
        let found = a_star(&view, source, is_goal, |_| 0)?;
        let mut legs = Vec::new();
        let mut at = from;
        for node in found.path.iter().skip(1) {
            let target = view.junctions.get(*node as usize)?;
            let enter = self.shortest_to(at.junction, *target)?;
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

    /// The shortest of the fragments that lead from one junction to another, by the end to enter it at.
    fn shortest_to(&self, from: JunctionId, to: JunctionId) -> Option<End> {
        let ports = 0..self.junction(from)?.degree();
        let ends = ports.filter_map(|number| {
            let port = Port {
                junction: from,
                number,
            };
            (self.beyond(port)?.junction == to).then(|| self.end_at(port))?
        });
        ends.min_by_key(|end| {
            let length = self.fragment(end.fragment).map(Fragment::length);
            (length, *end)
        })
    }
}

/// The map as planners see it: junctions by their rank.
struct View<'a> {
    map: &'a CpMap,
    junctions: Vec<JunctionId>,
}

impl<'a> View<'a> {
    fn of(map: &'a CpMap) -> Self {
        let junctions = map.junctions().map(|(id, _)| id).collect();
        Self { map, junctions }
    }

    fn index(&self, junction: JunctionId) -> Option<u32> {
        let index = self.junctions.binary_search(&junction).ok()?;
        Some(index as u32)
    }
}

impl Graph for View<'_> {
    fn node_count(&self) -> usize {
        self.junctions.len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let Some(&junction) = self.junctions.get(node as usize) else {
            return;
        };
        let degree = self.map.degree(junction);
        for number in 0..degree {
            let port = Port { junction, number };
            let fragment = self
                .map
                .end_at(port)
                .and_then(|end| self.map.fragment(end.fragment));
            if let (Some(head), Some(fragment)) = (self.map.beyond(port), fragment)
                && let Some(head) = self.index(head.junction)
            {
                visit(head, fragment.length());
            }
        }
    }
}
