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

/// The pairs to be looked at once more now that the robot is at `place`: those noted there, and those that one action
/// leads to from there. Notes that are settled are taken away.
pub(super) fn pairs(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
    let mut pairs = ends_of_one_action(map, place);
    pairs.extend(noted(map, place, config));
    pairs
}

/// Places that one action leads to from `place`.
fn ends_of_one_action(map: &Diktiometry, place: PlaceId) -> Vec<Pair> {
    let start = &map.paths.places[place.index()];
    let seen = |end: PlaceId| {
        let end = &map.paths.places[end.index()];
        let frames = if start.frame == end.frame {
            PointBox::ORIGIN
        } else {
            map.reference.relation(start.frame, end.frame)?.position
        };
        Some(frames + end.position)
    };
    let mut pairs = Vec::new();
    let links = || map.paths.outgoing(place);
    for (id, link) in links() {
        for (_, other) in links().filter(|(later, _)| *later > id) {
            if link.action == other.action
                && let (Some(a), Some(b)) = (seen(link.to), seen(other.to))
            {
                pairs.push(Pair {
                    a: link.to,
                    b: other.to,
                    offset: b - a,
                });
            }
        }
    }
    pairs
}

fn noted(map: &mut Diktiometry, place: PlaceId, config: &Config) -> Vec<Pair> {
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
