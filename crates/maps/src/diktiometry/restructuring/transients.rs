//! Transients: "non-existent states and transitions hallucinated due to nonreproducible conditions".

use alloc::vec::Vec;

use crate::diktiometry::config::{Config, Transients, Use};
use crate::diktiometry::counts::Counts;
use crate::diktiometry::ids::{LinkId, PlaceId};
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::path_graph::{Fate, Standing};
use crate::diktiometry::report::Restructured;

/// Elides the links from `place`'s neighbours to it and from it, and the places they lead to, that are met far less often than
/// they are expected. A place that tracks are at (`occupied`) stays. O(degree).
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
    let here = &map.paths.places[place.index()];
    let links: Vec<LinkId> = here
        .incoming
        .iter()
        .chain(&here.outgoing)
        .copied()
        .collect();
    let mut ends = Vec::new();
    for id in links {
        let link = &map.paths.links[id.index()];
        if link.standing == Standing::Standing && is_transient(&link.counts, &config.transients) {
            ends.push(link.to);
            map.paths.remove_link(id);
            done.push(Restructured::LinkElided(id));
        }
    }
    for end in ends {
        let there = &map.paths.places[end.index()];
        let unheard = there.incoming.is_empty() && is_transient(&there.counts, &config.transients);
        if there.fate == Fate::Standing && unheard && !occupied.contains(&end) {
            elide_place(map, end);
            done.push(Restructured::PlaceElided(end));
        }
    }
    done
}

/// Takes a place out of the map, with its links.
pub(in crate::diktiometry) fn elide_place(map: &mut Diktiometry, id: PlaceId) {
    let place = &map.paths.places[id.index()];
    let links: Vec<LinkId> = place
        .outgoing
        .iter()
        .chain(&place.incoming)
        .copied()
        .collect();
    for link in links {
        map.paths.remove_link(link);
    }
    let frame = map.paths.bury(id, Fate::Elided).frame;
    let places = &mut map.reference.frames[frame.index()].places;
    places.retain(|other| *other != id);
    if places.is_empty() {
        map.reference.clear(frame);
    }
}

/// Whether something is met, with 99 % certainty, in less than the configured share of the times it is expected.
fn is_transient(counts: &Counts, config: &Transients) -> bool {
    counts.rate_at_most(config.fading) < config.rate
}
