//! Transients: "non-existent states and transitions hallucinated due to nonreproducible
//! conditions".

use alloc::vec::Vec;

use tolman_geom::Point;

use crate::diktiometry::{
    Config, Counts, Diktiometry, Fate, Link, LinkStatus, PlaceId, Restructured, Transients, Use,
    WorldKind,
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
        let is_outvoted = is_outvoted(map, link, config);
        let is_hallucinated = is_outvoted || is_transient(&link.counts, &config.transients);
        if link.standing == LinkStatus::Standing && is_hallucinated {
            ends.push((link.to, is_outvoted));
            map.paths.remove_link(id);
            done.push(Restructured::LinkElided(id));
        }
    }
    for (end, is_outvoted) in ends {
        let there = map.place(end);
        let unheard = there.incoming.is_empty()
            && (is_outvoted || is_transient(&there.counts, &config.transients));
        // A place with a track may have merged since.
        let is_end = |track: &PlaceId| map.paths.resolve(*track) == Some(end);
        if there.fate == Fate::Standing && unheard && !occupied.iter().any(is_end) {
            elide_place(map, end);
            done.push(Restructured::PlaceElided(end));
        }
    }
    done
}

/// Number of times that an action has to lead elsewhere, for each that it led along a link, until
/// that link is not believed.
const OUTVOTED: u32 = 5;

/// Returns whether an action of a static world, which leads to one place only, led far more often
/// to another place than along this link, and bounds exclude that the two are one.
///
/// Beyond the paper, whose world may change.
fn is_outvoted(map: &Diktiometry, link: &Link, config: &Config) -> bool {
    let excludes = |other: &Link| {
        let offset = map.displacement(link.to, other.to, &config.search);
        offset.is_some_and(|offset| !offset.contains(Point::origin()))
    };
    let least = OUTVOTED.saturating_mul(link.traversed);
    let mut others = map.paths.along(link.from, link.action);
    config.world == WorldKind::Static
        && others.any(|(_, other)| other.traversed >= least && excludes(other))
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
