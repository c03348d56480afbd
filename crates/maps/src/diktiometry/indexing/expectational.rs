use alloc::vec::Vec;

use super::{Candidate, Expectation};
use crate::diktiometry::ids::{Action, PlaceId};
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::projector::Projection;

/// "Given a particular current place, the expectational candidates are those which are predicted by the last action taken
/// from that place." One set. O(degree · log degree).
pub(in crate::diktiometry) fn expected(
    map: &Diktiometry,
    place: PlaceId,
    action: Action,
    projection: &Projection,
) -> Vec<Candidate> {
    map.paths
        .along(place, action)
        .filter_map(|(_, link)| {
            let there = &map.paths.places[link.to.index()];
            let frames = map.reference.known(projection.frame, there.frame)?;
            let robot = projection.position - frames;
            Some(Candidate {
                place: link.to,
                robot,
                offset: there.position - robot,
                expectation: Expectation::Expected,
            })
        })
        .collect()
}
