//! Geometric constraints: "all places are at least some minimum distance apart (call it δ_sep)".

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::Verdict;
use crate::diktiometry::config::{Config, GeometricMerge};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::reference_graph::search;

/// Two places that may be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) a: PlaceId,
    pub(super) b: PlaceId,
    /// Where b lies as seen from a, m.
    pub(super) offset: PointBox,
}

/// Places of the frames around that of `place` which may be one: once two places are merged, what lies around them follows.
pub(super) fn neighbours(map: &Diktiometry, place: PlaceId) -> Vec<Pair> {
    let frame = map.paths.places[place.index()].frame;
    let frames = &map.reference.frames;
    let near: Vec<(PlaceId, PointBox)> = frames[frame.index()]
        .relations
        .iter()
        .flat_map(|relation| {
            let places = &frames[relation.to.index()].places;
            places.iter().map(move |&place| {
                let there = map.paths.places[place.index()].position;
                (place, relation.position + there)
            })
        })
        .collect();
    let mut pairs = Vec::new();
    for (number, &(a, at)) in near.iter().enumerate() {
        for &(b, there) in near
            .iter()
            .skip(number + 1)
            .filter(|(_, there)| at.meets(*there))
        {
            pairs.push(Pair {
                a,
                b,
                offset: there - at,
            });
        }
    }
    pairs
}

/// The pairs noted at `place`, with what is known of them now. Notes that are settled are taken away.
pub(super) fn noted(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    let notes = core::mem::take(&mut map.paths.places[place.index()].notes);
    if notes.is_empty() {
        return Vec::new();
    }
    let here = &map.paths.places[place.index()];
    let (frame, position) = (here.frame, here.position);
    let reached = search(&map.reference, frame, &config.search);
    let mut pairs: Vec<Pair> = Vec::new();
    let mut left = Vec::new();
    for mut note in notes {
        let Some(other) = map
            .paths
            .resolve(note.other)
            .filter(|other| *other != place)
        else {
            continue; // It was settled elsewhere.
        };
        if left.contains(&other) {
            continue;
        }
        let there = &map.paths.places[other.index()];
        let way = reached.iter().find(|reached| reached.frame == there.frame);
        let offset = way.map(|way| way.position + there.position - position);
        // What cannot be one is settled, too.
        if offset.is_none_or(|offset| offset.contains(Point::origin())) {
            left.push(other);
            note.other = other;
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
pub(super) fn merge(pair: &Pair, config: &Config) -> Verdict {
    if !pair.offset.contains(Point::origin()) {
        return Verdict::Reject;
    }
    match config.restructuring.geometric_merge {
        GeometricMerge::Narrow if pair.offset.norm().high() < config.least_distance() => {
            Verdict::Propose
        }
        GeometricMerge::Off | GeometricMerge::Narrow | GeometricMerge::Estims => Verdict::Abstain,
    }
}
