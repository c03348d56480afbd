//! Transients: "non-existent states and transitions hallucinated due to nonreproducible
//! conditions".

use alloc::vec::Vec;

use crate::diktiometry::{
    Config, Counts, Diktiometry, Fate, LinkStatus, PlaceId, Restructured, Transients, Use,
};

/// Elides links from and to `place`, and the places at their ends, that are met far less often than
/// expected. Returns the changes. A place with tracks (`occupied`) stays. O(degree).
pub(super) fn elide(
    map: &mut Diktiometry,
    place: PlaceId,
    occupied: &[PlaceId],
    config: &Config,
) -> Vec<Restructured> {
    let mut done = Vec::new();
    if config.transients.elision == Use::Off {
        return done;
    }
    let mut ends = Vec::new();
    for id in map.place(place).links() {
        let link = map.link(id);
        if link.standing == LinkStatus::Standing && is_transient(&link.counts, &config.transients) {
            ends.push(link.to);
            map.paths.remove_link(id);
            done.push(Restructured::LinkElided(id));
        }
    }
    for end in ends {
        let there = map.place(end);
        let unheard = there.incoming.is_empty() && is_transient(&there.counts, &config.transients);
        if there.fate == Fate::Standing && unheard && !occupied.contains(&end) {
            elide_place(map, end);
            done.push(Restructured::PlaceElided(end));
        }
    }
    done
}

/// Removes a place and its links from the map.
pub(crate) fn elide_place(map: &mut Diktiometry, id: PlaceId) {
    for link in map.place(id).links() {
        map.paths.remove_link(link);
    }
    let frame = map.paths.bury(id, Fate::Elided).frame;
    let places = &mut map.frame_mut(frame).places;
    places.retain(|other| *other != id);
    if places.is_empty() {
        map.reference.clear(frame);
    }
}

/// Returns whether something is met, with 99 % certainty, in less than the configured share of the
/// times it is expected.
fn is_transient(counts: &Counts, config: &Transients) -> bool {
    counts.rate_at_most(config.fading) < config.rate
}
