//! Constraints of a static world: an action leads from a place to one place, and its reverse from
//! there back.
//!
//! Beyond the paper, whose world may change.

use super::Verdict;
use super::geometric::Pair;
use crate::diktiometry::{Action, Config, Diktiometry, PlaceId, WorldKind};

/// Returns a pair of places that are one because one action leads to both from one place. Geometry
/// may still forbid the merge. O(degree²).
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    if config.world == WorldKind::Changing {
        return Verdict::Abstain;
    }
    let leads_to_both = |way| beside(map, pair.b, config).any(|other| other == way);
    Verdict::propose_if(beside(map, pair.a, config).any(leads_to_both))
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
