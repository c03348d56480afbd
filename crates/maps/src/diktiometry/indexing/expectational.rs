use alloc::vec::Vec;

use crate::diktiometry::{Candidate, Diktiometry, Expectation, Projection};

/// "Given a particular current place, the expectational candidates are those which are predicted by the last action taken
/// from that place." One set. O(degree · log degree).
pub(crate) fn expected(map: &Diktiometry, projection: &Projection) -> Vec<Candidate> {
    let links = map.paths.along(projection.from, projection.action);
    let candidates = links.filter_map(|(_, link)| {
        let there = map.place(link.to).frame;
        let robot = projection.position - map.reference.known(projection.frame, there)?;
        Some(Candidate::new(map, link.to, robot, Expectation::Expected))
    });
    candidates.collect()
}
