//! Geometric constraints: "all places are at least some minimum distance apart (call it δ_sep)".

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::look_agreement::{Agreement, agreement, offset_anywhere};
use super::{Diagnosis, Verdict, one_way};
use crate::diktiometry::{
    Config, Diktiometry, Estim, GeometricMerge, Ground, MergeNote, PlaceId, Use, learn_of_two,
    merge_estims, search, similarity, wanted_anywhere,
};

/// Two places that may be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) a: PlaceId,
    pub(super) b: PlaceId,
    /// Position of b relative to a, m.
    pub(super) offset: PointBox,
}

/// Returns the places of nearby frames, with their positions in the frame of `place`, m.
pub(super) fn around(map: &Diktiometry, place: PlaceId) -> Vec<(PlaceId, PointBox)> {
    let relations = map.reference.relations(map.place(place).frame);
    let places = relations.flat_map(|relation| {
        let places = map.frame(relation.to).places.iter();
        places.map(move |&place| (place, relation.position + map.place(place).position))
    });
    places.collect()
}

/// Returns the pairs of places that may be one. After a merge, the places around it are tried next.
/// There may be O(places²) pairs, so they are not stored.
pub(super) fn meeting(near: &[(PlaceId, PointBox)]) -> impl Iterator<Item = Pair> {
    near.iter().enumerate().flat_map(|(number, &(a, at))| {
        let others = near.iter().skip(number + 1);
        let meet = others.filter(move |(_, there)| at.meets(*there));
        meet.map(move |&(b, there)| {
            let offset = there - at;
            Pair { a, b, offset }
        })
    })
}

/// Returns whether a place has a note that another may be the same by its position.
pub(super) fn is_nearness_noted(map: &Diktiometry, place: PlaceId) -> bool {
    let notes = &map.place(place).notes;
    notes.iter().any(|note| note.ground == Ground::Position)
}

/// Takes the notes at `place` and returns them with the present ids of their places. Notes settled
/// elsewhere are left out.
pub(super) fn take_notes(map: &mut Diktiometry, place: PlaceId) -> Vec<MergeNote> {
    let mut notes = core::mem::take(&mut map.place_mut(place).notes);
    let mut seen: Vec<PlaceId> = Vec::new();
    notes.retain_mut(|note| {
        let other = map.paths.resolve(note.other);
        let Some(other) = other.filter(|other| *other != place && !seen.contains(other)) else {
            return false;
        };
        seen.push(other);
        note.other = other;
        true
    });
    notes
}

/// Returns the pairs noted at `place`, with their present bounds. Settled notes are removed.
pub(super) fn noted(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    let notes = take_notes(map, place);
    if notes.is_empty() {
        return Vec::new();
    }
    let (frame, position) = map.site(place);
    let reached = search(&map.reference, frame, &config.search);
    let wanted = wanted_anywhere(map, config);
    let mut pairs: Vec<Pair> = Vec::new();
    for note in notes {
        let (a, b) = (place, note.other);
        let (frame, there) = map.site(b);
        let way = reached.iter().find(|reached| reached.frame == frame);
        let mut offset = way.map(|way| way.position + there - position);
        if let (None, Some(wanted)) = (offset, wanted) {
            match agreement(map, a, b, wanted, config) {
                Agreement::Enough => offset = Some(offset_anywhere(map, a, b)),
                Agreement::Broken if note.ground == Ground::Look => continue,
                Agreement::Broken | Agreement::TooLittle => {}
            }
        }
        // What cannot be one is settled, too. It was noted at both.
        let apart = offset.is_some_and(|offset| !offset.contains(Point::origin()));
        if apart && a < b {
            let look = similarity(map.place(a), map.place(b), &config.percepts);
            learn_of_two(map, [a, b], look, config);
        }
        if !apart {
            map.place_mut(place).notes.push(note);
        }
        pairs.extend(offset.map(|offset| Pair { a, b, offset }));
    }
    pairs
}

/// Returns the opinion on merging two places by their positions.
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    match config.restructuring.geometric_merge {
        GeometricMerge::Off => Verdict::Abstain,
        _ if !pair.offset.contains(Point::origin()) => {
            if one_way::overrules_bounds(map, pair, config) {
                Verdict::Abstain
            } else {
                Verdict::Reject
            }
        }
        GeometricMerge::Narrow => {
            let most = config.apart.most(pair.offset);
            Verdict::propose_if(most < least_distance(map, pair, config))
        }
        GeometricMerge::Estims => Verdict::propose_if(have_one_mode(map, pair, config)),
    }
}

/// Returns the minimum distance of the two places, m, as if they were different.
fn least_distance(map: &Diktiometry, pair: &Pair, config: &Config) -> f64 {
    let [a, b] = [pair.a, pair.b].map(|place| map.place(place));
    let look = similarity(a, b, &config.percepts);
    config.least_distance_of(look, [&a.exits, &b.exits])
}

/// Returns whether the estims of two places merge into one mode. "When two places have estim sets
/// that can be merged such that the resultant set has one estim with weight greater than a
/// threshold and no other estim's weight is greater than a threshold fraction of the first, a merge
/// is indicated."
fn have_one_mode(map: &Diktiometry, pair: &Pair, config: &Config) -> bool {
    let [a, b] = [pair.a, pair.b].map(|place| map.place(place));
    let shift = pair.offset.middle() + (a.position.middle() - b.position.middle());
    let mut union = a.estims.clone();
    union.extend(b.estims.iter().map(|estim| estim.shifted(shift)));
    merge_estims(&mut union, config.separation);
    let union = heaviest_first(union);
    let weight = |number: usize| union.get(number).map_or(0.0, |estim| estim.weight);
    let limits = &config.restructuring;
    weight(0) > limits.weight && weight(1) <= limits.minority * weight(0)
}

fn heaviest_first(mut estims: Vec<Estim>) -> Vec<Estim> {
    estims.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    estims
}

/// Returns the diagnosis that a place's estims are two. "Eventually the estim set will contain two
/// estims with weight greater than a threshold, and with weight ratio (max/min) less than a
/// threshold. So when this occurs, a split is indicated."
pub(super) fn split(map: &Diktiometry, place: PlaceId, config: &Config) -> Option<Diagnosis> {
    let limits = &config.restructuring;
    if limits.geometric_split == Use::Off {
        return None;
    }
    let estims = heaviest_first(map.place(place).estims.clone());
    let &[stays, leaves, ..] = estims.as_slice() else {
        return None;
    };
    let indicated = leaves.weight > limits.weight && stays.weight / leaves.weight < limits.ratio;
    indicated.then_some(Diagnosis::Estims { stays, leaves })
}
