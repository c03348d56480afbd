use alloc::vec::Vec;

use super::{Candidate, Expectation};
use crate::diktiometry::{Diktiometry, Projection, Reached};

/// Returns the places of the reached frames whose position may be the robot's. There is one set for
/// each number of relations on the way: "each ply of the search is less plausible". O(places in
/// these frames).
pub(crate) fn plies(
    map: &Diktiometry,
    reached: &[Reached],
    projection: &Projection,
) -> Vec<Vec<Candidate>> {
    let mut plies: Vec<Vec<Candidate>> = Vec::new();
    for frame in reached {
        let robot = projection.position - frame.position;
        for &place in &map.frame(frame.frame).places {
            let candidate = Candidate::new(map, place, robot, Expectation::Unexpected);
            if candidate.is_possible() || map.place(place).envelope.meets(robot) {
                let ply = frame.hops as usize;
                if plies.len() <= ply {
                    plies.resize_with(ply + 1, Vec::new);
                }
                plies[ply].push(candidate);
            }
        }
    }
    plies.retain(|ply| !ply.is_empty());
    plies
}
