//! Constraints of a static world: an action leads from a place to one place, and its reverse from
//! there back.
//!
//! Beyond the paper, whose world may change.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use tolman_geom::Point;

use super::Verdict;
use super::geometric::Pair;
use crate::diktiometry::{Action, Config, Diktiometry, PlaceId, WorldKind};

/// Number of ways that lead to two places too near to be two until the bounds that exclude that
/// they are one are not believed.
const SHARED: usize = 2;

/// Returns a pair of places that are one because one action leads to both from one place. Geometry
/// may still forbid the merge. O(degree²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    if config.world == WorldKind::Changing {
        return Verdict::Abstain;
    }
    Verdict::propose_if(shared(map, pair, config).next().is_some())
}

/// Returns whether two places that exclude each other by their bounds are one. They are nearer than
/// two places can be, so a bound was broken, and several ways lead to both. O(degree²).
pub(super) fn overrules_bounds(map: &Diktiometry, pair: &Pair, config: &Config) -> bool {
    let exits = [pair.a, pair.b].map(|place| &map.place(place).exits);
    config.world == WorldKind::Static
        && config.apart.most(pair.offset) < config.least_distance()
        && config.may_be_same(exits)
        && shared(map, pair, config).count() >= SHARED
}

/// Returns the places that bounds hold apart from `place`, maybe wrongly: an action that led to it
/// led to them, too. O(degree · a search) if there are any.
pub(super) fn doubles(map: &Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    if config.world == WorldKind::Changing {
        return Vec::new();
    }
    let incoming = map.paths.incoming(place);
    let others = incoming.flat_map(|(_, link)| map.paths.along(link.from, link.action));
    let others = others.map(|(_, link)| link.to).filter(|to| *to != place);
    let pair = |other| {
        let offset = map.displacement(place, other, &config.search)?;
        let (a, b) = (place, other);
        let excludes = !offset.contains(Point::origin());
        excludes.then_some(Pair { a, b, offset })
    };
    others.filter_map(pair).collect()
}

/// Returns the ways that lead to both places of a pair.
fn shared<'a>(
    map: &'a Diktiometry,
    pair: &'a Pair,
    config: &'a Config,
) -> impl Iterator<Item = (PlaceId, Action)> + 'a {
    let ways: BTreeSet<(PlaceId, Action)> = beside(map, pair.a, config).collect();
    let both = ways.into_iter();
    both.filter(|way| beside(map, pair.b, config).any(|other| other == *way))
}

/// Returns the places and actions that lead to a place: by the reverse of its links, or by their
/// own.
pub(super) fn beside<'a>(
    map: &'a Diktiometry,
    place: PlaceId,
    config: &'a Config,
) -> impl Iterator<Item = (PlaceId, Action)> + 'a {
    let came = map.paths.incoming(place);
    let came = came.map(|(_, link)| (link.from, link.action));
    let left = map.paths.outgoing(place);
    let left = left.filter_map(|(_, link)| Some((link.to, config.reverse(link.action)?)));
    left.chain(came)
}
