use alloc::vec::Vec;

use crate::diktiometry::{
    Candidate, Config, Diktiometry, Expectation, Identity, PlaceId, Projection, WorldKind,
};

/// Returns the expectational candidates: "Given a particular current place, the expectational
/// candidates are those which are predicted by the last action taken from that place." One set.
/// O(degree · log degree).
///
/// Beyond the paper, the reverse of the action that led here leads back, but not in a changing
/// world by the paper's rule of matching.
pub(crate) fn expected(
    map: &Diktiometry,
    projection: &Projection,
    config: &Config,
) -> Vec<Candidate> {
    let links = map.paths.along(projection.from, projection.action);
    let mut ends: Vec<PlaceId> = links.map(|(_, link)| link.to).collect();
    for end in back(map, projection, config) {
        if !ends.contains(&end) {
            ends.push(end);
        }
    }
    let candidates = ends.into_iter().filter_map(|end| {
        let there = map.place(end).frame;
        let robot = projection.position - map.reference.known(projection.frame, there)?;
        Some(Candidate::new(map, end, robot, Expectation::Expected))
    });
    candidates.collect()
}

/// Returns the places from which the reverse of the action led here.
fn back(
    map: &Diktiometry,
    projection: &Projection,
    config: &Config,
) -> impl Iterator<Item = PlaceId> {
    let is_by_the_paper = config.matching.identity == Identity::Meets;
    let reverse = match (config.world, is_by_the_paper) {
        (WorldKind::Changing, true) => None,
        _ => config.reverse(projection.action),
    };
    let incoming = map.paths.incoming(projection.from);
    let back = incoming.filter(move |(_, link)| Some(link.action) == reverse);
    back.map(|(_, link)| link.from)
}
