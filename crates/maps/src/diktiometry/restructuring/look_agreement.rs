//! Merges places by looks, where the map has learned that looks are evidence of identity.
//!
//! Beyond the paper, which compares histories of places that were considered and rejected. After a
//! long way the box of a position has room for several places. Where there are many looks, the
//! places along the same actions decide.

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::Verdict;
use super::geometric::{Pair, take_notes};
use crate::diktiometry::{
    Agreeing, Config, Diktiometry, PlaceId, SearchLimits, Similarity, Use, share_a_view, similarity,
};

/// Maximum number of pairs of places that are compared.
const COMPARED: usize = 64;

/// Number of places that one may be mistaken for if an action relates the two to one place
/// ([`share_a_way`]). It is the maximum rate at which the action leads elsewhere than before, or
/// not back. The world may have changed, or the place may be two.
const ELSEWHERE: f64 = 1e-3;

/// Returns the opinion on merging two places by their looks, and those of the places along the same
/// actions.
///
/// The same actions lead from one place to the same places. If the two are different, so are the
/// ends of the same actions. Each pair of ends looks alike with a probability of about p
/// ([`Looks`](crate::diktiometry::Looks)).
///
/// With k kinds of looks in agreement and n places to be mistaken for, the error probability is at
/// most about n · pᵏ. There p is the mean over all pairs, and some looks are commoner than others.
/// The number of places n is estimated as the number of kinds of looks, plus two. The number of
/// places on the map is no measure while it is not folded. If one action led from one place to
/// both, a mistake requires that the action has led elsewhere.
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    if config.restructuring.look_merge == Use::Off {
        return Verdict::Abstain;
    }
    // Looks stretch what geometry allows, never break it: also where geometry has no say of its
    // own.
    if !pair.offset.contains(Point::origin()) {
        return Verdict::Reject;
    }
    let separation = config.least_distance();
    let sides = [pair.offset.x, pair.offset.y].map(|side| side.width() / separation + 1.0);
    let others = if share_a_way(map, pair, config) {
        ELSEWHERE
    } else {
        sides[0] * sides[1]
    };
    let enough = enough(map, others, config)
        .is_some_and(|wanted| agreement(map, pair.a, pair.b, wanted, config) == Agreement::Enough);
    Verdict::propose_if(enough)
}

/// Returns whether one action led to both from one place, or from both to one place and the action
/// back leads to either.
fn share_a_way(map: &Diktiometry, pair: &Pair, config: &Config) -> bool {
    let Pair { a, b, .. } = *pair;
    let paths = &map.paths;
    let leads = |from, action, to| paths.between(from, action, to).is_some();
    let mut incoming = paths.incoming(a);
    incoming.any(|(_, link)| leads(link.from, link.action, b))
        || paths.outgoing(a).any(|(_, link)| {
            let back = config.reverse(link.action);
            let leads_back = |place| back.is_some_and(|back| leads(link.to, back, place));
            leads(b, link.action, link.to) && (leads_back(a) || leads_back(b))
        })
}

/// Returns the bounds on b's position relative to a by all that is known, m: geometry has its say
/// before a merge. O(frames · degree · log frames).
pub(super) fn offset_anywhere(map: &Diktiometry, a: PlaceId, b: PlaceId) -> PointBox {
    let known = map.displacement(a, b, &SearchLimits::UNLIMITED);
    known.unwrap_or(PointBox::UNBOUNDED)
}

/// Returns the pairs noted at `place` that are one by their looks, without a search of the
/// neighbourhood. Settled notes are removed.
pub(super) fn noted(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    let Some(wanted) = wanted_anywhere(map, config) else {
        return Vec::new();
    };
    let mut pairs = Vec::new();
    let mut notes = take_notes(map, place);
    notes.retain(|note| {
        let (a, b) = (place, note.other);
        let agreement = agreement(map, a, b, wanted, config);
        if agreement == Agreement::Enough {
            let offset = offset_anywhere(map, a, b);
            pairs.push(Pair { a, b, offset });
        }
        agreement != Agreement::Broken
    });
    map.place_mut(place).notes = notes;
    pairs
}

/// Learns about looks from two places that geometry has told apart.
pub(crate) fn learn_of_two(
    map: &mut Diktiometry,
    pair: [PlaceId; 2],
    look: Similarity,
    config: &Config,
) {
    let neighbours = match look {
        Similarity::Alike => neighbours(map, pair, config),
        Similarity::Unlike => None,
    };
    map.looks.count(look, neighbours);
}

/// Returns the similarity of two neighbours, one of each place of the pair. The same action leads
/// from them to the pair, or else from the pair to them. `None` if neither exist.
fn neighbours(map: &Diktiometry, [a, b]: [PlaceId; 2], config: &Config) -> Option<Similarity> {
    let paths = &map.paths;
    let before = paths.incoming(a).find_map(|(_, link)| {
        let mut others = paths.incoming(b).map(|(_, other)| other);
        let other = others.find(|other| other.action == link.action && other.from != link.from);
        Some((link.from, other?.from))
    });
    let after = || {
        paths.outgoing(a).find_map(|(_, link)| {
            let mut others = paths.along(b, link.action).map(|(_, other)| other.to);
            Some((link.to, others.find(|to| *to != link.to)?))
        })
    };
    let (one, other) = before.or_else(after)?;
    let [one, other] = [one, other].map(|end| map.place(end));
    Some(similarity(one, other, &config.percepts))
}

/// Returns how many looks have to agree where geometry knows nothing. `None` if looks alone decide
/// nothing there.
pub(crate) fn wanted_anywhere(map: &Diktiometry, config: &Config) -> Option<Agreeing> {
    match config.restructuring.look_merge {
        Use::On => enough(map, f64::INFINITY, config),
        Use::Off => None,
    }
}

/// Returns how many looks have to agree if there is room for `room` places, or `None` if no number
/// is enough.
fn enough(map: &Diktiometry, room: f64, config: &Config) -> Option<Agreeing> {
    let others = room.min(f64::from(map.looks.kinds) + 2.0);
    map.looks.enough(config.restructuring.look_error / others)
}

/// Agreement of looks along the same actions from two places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Agreement {
    /// Enough looks agree.
    Enough,
    /// Fewer looks agree, as far as is known.
    TooLittle,
    /// The two are different: a look differs, or two places that would be one are told apart by
    /// geometry.
    Broken,
}

/// Returns whether `wanted` looks agree along the same actions from two places, and
/// nothing contradicts that the two are one.
pub(super) fn agreement(
    map: &Diktiometry,
    a: PlaceId,
    b: PlaceId,
    wanted: Agreeing,
    config: &Config,
) -> Agreement {
    let paths = &map.paths;
    let alike = |a, b| share_a_view(map.place(a), map.place(b), &config.percepts);
    let unseen = |place| map.place(place).views.is_empty();
    let mut pairs = Vec::from([(a, b)]);
    let mut kinds: Vec<PlaceId> = Vec::new();
    let mut paired: Vec<PlaceId> = Vec::new();
    let mut next = 0;
    while let Some(&(a, b)) = pairs.get(next) {
        next += 1;
        if unseen(a) || unseen(b) || !alike(a, b) {
            return Agreement::Broken;
        }
        if kinds.iter().all(|&kind| !alike(kind, a)) {
            kinds.push(a);
        }
        // A place that is compared twice is no second evidence.
        if !paired.contains(&a) && !paired.contains(&b) {
            paired.extend([a, b]);
        }
        if kinds.len() >= wanted.kinds && paired.len() >= 2 * wanted.places {
            return Agreement::Enough;
        }
        for (_, link) in paths.ways(a) {
            let way = paths.ways(b).find(|(_, other)| other.action == link.action);
            let Some((_, other)) = way else {
                continue;
            };
            let ends = (link.to, other.to);
            if ends.0 == ends.1 || pairs.contains(&ends) || pairs.len() >= COMPARED {
                continue;
            }
            // The two ways are one if the places are.
            let ways = map.related(a, link.to).zip(map.related(b, other.to));
            let offset = map.related(ends.0, ends.1);
            if offset.is_some_and(|offset| !offset.contains(Point::origin()))
                || ways.is_some_and(|(one, other)| !one.meets(other))
            {
                return Agreement::Broken;
            }
            pairs.push(ends);
        }
    }
    Agreement::TooLittle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_apart_is_never_one_however_it_looks() {
        let mut config = Config::new(Config::compass_actions(), 1.0);
        config.restructuring.look_merge = Use::On;
        let verdict = |x: f64| {
            let pair = Pair {
                a: PlaceId(0),
                b: PlaceId(1),
                offset: PointBox::about(Point::new(x, 0.0), 0.5).unwrap(),
            };
            merge(&Diktiometry::default(), &pair, &config)
        };
        assert_eq!(verdict(0.25), Verdict::Abstain);
        assert_eq!(verdict(2.0), Verdict::Reject);
    }
}
