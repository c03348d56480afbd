//! Transients: "non-existent states and transitions hallucinated due to nonreproducible conditions".

use alloc::vec::Vec;

use crate::diktiometry::config::{Config, Transients, Use};
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
        if link.standing == Standing::Standing
            && is_transient(link.met, link.expected, &config.transients)
        {
            ends.push(link.to);
            map.paths.remove_link(id);
            done.push(Restructured::LinkElided(id));
        }
    }
    for end in ends {
        let there = &map.paths.places[end.index()];
        let unheard = there.incoming.is_empty()
            && is_transient(there.met, there.expected, &config.transients);
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
    let frame = map.paths.places[id.index()].bury(Fate::Elided).frame;
    let places = &mut map.reference.frames[frame.index()].places;
    places.retain(|other| *other != id);
    if places.is_empty() {
        map.reference.clear(frame);
    }
}

/// Whether something is met, for certain, in less than the configured share of the times it is expected.
fn is_transient(met: f64, expected: f64, config: &Transients) -> bool {
    expected >= config.expected && wilson_upper(met, expected) < config.rate
}

/// The upper end of Wilson's score interval at 99 % for a rate of which `met` of `expected` were seen.
fn wilson_upper(met: f64, expected: f64) -> f64 {
    /// The 99.5th percentile of the standard normal.
    const Z: f64 = 2.575_829_303_548_901;
    let rate = met / expected;
    let square = Z * Z / expected;
    let spread = libm::sqrt(rate * (1.0 - rate) / expected + square / (4.0 * expected));
    (rate + 0.5 * square + Z * spread) / (1.0 + square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_agrees_with_the_textbook() {
        // 0 of n: z² / (n + z²).
        assert!((wilson_upper(0.0, 20.0) - 6.634_896_6 / 26.634_896_6).abs() < 1e-8);
        // n / 2 of n: 1/2 + z / (2 √(n + z²)).
        assert!((wilson_upper(5.0, 10.0) - 0.815_774_5).abs() < 1e-7);
    }
}
