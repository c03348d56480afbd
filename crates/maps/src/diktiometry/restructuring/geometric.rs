//! Geometric constraints: "all places are at least some minimum distance apart (call it δ_sep)".

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::look_agreement::{self, Sight};
use super::{Diagnosis, Verdict};
use crate::diktiometry::config::{Config, GeometricMerge, Use};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::matching::{share_a_view, similarity};
use crate::diktiometry::path_graph::{Estim, Ground, Note};
use crate::diktiometry::reference_graph::search;
use crate::diktiometry::updater::merge_estims;

/// Two places that may be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) a: PlaceId,
    pub(super) b: PlaceId,
    /// Where b lies as seen from a, m.
    pub(super) offset: PointBox,
}

/// Places of the frames around that of `place`, with where they are as seen from its frame, m.
pub(super) fn around(map: &Diktiometry, place: PlaceId) -> Vec<(PlaceId, PointBox)> {
    let frame = map.paths.places[place.index()].frame;
    let frames = &map.reference.frames;
    let relations = frames[frame.index()].relations.iter();
    let places = relations.flat_map(|relation| {
        let places = &frames[relation.to.index()].places;
        places.iter().map(move |&place| {
            let there = map.paths.places[place.index()].position;
            (place, relation.position + there)
        })
    });
    places.collect()
}

/// Those of some places that may be one: once two places are merged, what lies around them follows. There may be as many pairs as the
/// square of the places, so that nobody keeps them.
pub(super) fn meeting(near: &[(PlaceId, PointBox)]) -> impl Iterator<Item = Pair> {
    near.iter().enumerate().flat_map(|(number, &(a, at))| {
        let others = near.iter().skip(number + 1);
        let meet = others.filter(move |(_, there)| at.meets(*there));
        meet.map(move |&(b, there)| Pair {
            a,
            b,
            offset: there - at,
        })
    })
}

/// Whether it is noted at a place that another may be one with it by its position.
pub(super) fn is_nearness_noted(map: &Diktiometry, place: PlaceId) -> bool {
    let notes = &map.paths.places[place.index()].notes;
    notes.iter().any(|note| note.ground == Ground::Position)
}

/// The notes at `place`, taken from it, with the places they mean by their names now; those that were settled elsewhere are left out.
pub(super) fn take_notes(map: &mut Diktiometry, place: PlaceId) -> Vec<Note> {
    let mut notes = core::mem::take(&mut map.paths.places[place.index()].notes);
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

/// The pairs noted at `place`, with what is known of them now. Notes that are settled are taken away.
pub(super) fn noted(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    let notes = take_notes(map, place);
    if notes.is_empty() {
        return Vec::new();
    }
    let here = &map.paths.places[place.index()];
    let (frame, position) = (here.frame, here.position);
    let reached = search(&map.reference, frame, &config.search);
    let wanted = look_agreement::wanted_anywhere(map, config);
    let mut pairs: Vec<Pair> = Vec::new();
    for note in notes {
        let other = note.other;
        let there = &map.paths.places[other.index()];
        let way = reached.iter().find(|reached| reached.frame == there.frame);
        let mut offset = way.map(|way| way.position + there.position - position);
        if let (None, Some(wanted)) = (offset, wanted) {
            match look_agreement::out_of_reach(map, place, other, wanted, config) {
                Sight::Same(there) => offset = Some(there),
                Sight::Different if note.ground == Ground::Look => continue,
                Sight::Different | Sight::Open => {}
            }
        }
        // What cannot be one is settled, too. It was noted at both.
        let apart = offset.is_some_and(|offset| !offset.contains(Point::origin()));
        if apart && place < other {
            let [a, b] = [place, other].map(|place| &map.paths.places[place.index()]);
            let look = similarity(a, b, &config.percepts);
            look_agreement::learn_of_two(map, [place, other], look, config);
        }
        if !apart {
            map.paths.places[place.index()].notes.push(note);
        }
        if let Some(offset) = offset {
            pairs.push(Pair {
                a: place,
                b: other,
                offset,
            });
        }
    }
    pairs
}

/// Whether two places may be merged by where they are.
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    let limits = &config.restructuring;
    if limits.geometric_merge == GeometricMerge::Off {
        return Verdict::Abstain;
    }
    if !pair.offset.contains(Point::origin()) {
        return Verdict::Reject;
    }
    let proposed = match limits.geometric_merge {
        GeometricMerge::Narrow => pair.offset.norm().high() < least_distance(map, pair, config),
        GeometricMerge::Estims => have_one_mode(map, pair, config),
        GeometricMerge::Off => false,
    };
    if proposed {
        Verdict::Propose
    } else {
        Verdict::Abstain
    }
}

/// How far apart the two are at the least if they are two.
fn least_distance(map: &Diktiometry, pair: &Pair, config: &Config) -> f64 {
    let [a, b] = [pair.a, pair.b].map(|place| &map.paths.places[place.index()]);
    if share_a_view(a, b, &config.percepts) {
        config.least_alike_distance()
    } else {
        config.least_distance()
    }
}

/// "When two places have estim sets that can be merged such that the resultant set has one estim with weight greater than
/// a threshold and no other estim's weight is greater than a threshold fraction of the first, a merge is indicated."
fn have_one_mode(map: &Diktiometry, pair: &Pair, config: &Config) -> bool {
    let [a, b] = [pair.a, pair.b].map(|place| &map.paths.places[place.index()]);
    let shift = pair.offset.middle() + (a.position.middle() - b.position.middle());
    let mut union = a.estims.clone();
    union.extend(b.estims.iter().map(|estim| Estim {
        position: estim.position + shift.coords,
        weight: estim.weight,
    }));
    merge_estims(&mut union, config.separation);
    let weights = sorted_weights(&union);
    let (first, second) = (weights.first(), weights.get(1));
    let limits = &config.restructuring;
    first.is_some_and(|first| {
        *first > limits.weight && second.is_none_or(|second| *second <= limits.minority * first)
    })
}

fn sorted_weights(estims: &[Estim]) -> Vec<f64> {
    let mut weights: Vec<f64> = estims.iter().map(|estim| estim.weight).collect();
    weights.sort_by(|a, b| b.total_cmp(a));
    weights
}

/// "Eventually the estim set will contain two estims with weight greater than a threshold, and with weight ratio
/// (max/min) less than a threshold. So when this occurs, a split is indicated."
pub(super) fn split(map: &Diktiometry, place: PlaceId, config: &Config) -> Option<Diagnosis> {
    let limits = &config.restructuring;
    if limits.geometric_split == Use::Off {
        return None;
    }
    let mut estims = map.paths.places[place.index()].estims.clone();
    estims.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    let &[stays, leaves, ..] = estims.as_slice() else {
        return None;
    };
    let indicated = leaves.weight > limits.weight && stays.weight / leaves.weight < limits.ratio;
    indicated.then_some(Diagnosis::Estims { stays, leaves })
}
