use alloc::vec::Vec;

use tolman_geom::PointBox;

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
    map.outcomes(place, action)
        .filter_map(|(_, to, _)| {
            let there = &map.paths.places[to.index()];
            let frame_from_there = if there.frame == projection.frame {
                PointBox::ORIGIN
            } else {
                map.reference
                    .relation(projection.frame, there.frame)?
                    .position
            };
            let robot = projection.position - frame_from_there;
            Some(Candidate {
                place: to,
                robot,
                offset: there.position - robot,
                expectation: Expectation::Expected,
            })
        })
        .collect()
}
