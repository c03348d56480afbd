//! Restructures the map: integrates many observations, and repairs errors of matching.

mod geometric;
mod local_path;
mod look_agreement;
mod merge;
mod non_local_path;
mod one_way;
mod split;
mod transients;
mod winding;

use alloc::vec::Vec;

use super::{
    Config, Diktiometry, Distinction, Estim, Fate, GeometricMerge, LinkId, PlaceId, Restructured,
    Restructurer, share_a_view,
};
pub(super) use look_agreement::{learn_of_two, wanted_anywhere};
pub(super) use non_local_path::deposit;
pub(super) use transients::elide_place;

/// Opinion of a restructurer on a diagnosis.
///
/// "If a diagnosis of either monotopy or polytopy is proposed by at least one restructurer, and is
/// not rejected by any, we accept the diagnosis."
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Propose,
    Abstain,
    Reject,
}

impl Verdict {
    const fn propose_if(grounds: bool) -> Self {
        if grounds {
            Self::Propose
        } else {
            Self::Abstain
        }
    }
}

/// Polytopy: one place that is two in the world.
#[derive(Clone, Debug, PartialEq)]
enum Diagnosis {
    /// The place was seen at two points.
    Estims {
        /// Point that the old place keeps.
        stays: Estim,
        /// Point of the new place.
        leaves: Estim,
    },
    /// The continuation depends on the way by which the robot came.
    Links {
        /// Links that lead to the new place.
        incoming: Vec<LinkId>,
    },
}

/// Returns who first proposed that two places are one, if none rejects it. Stops at the first
/// rejection.
fn accepted(map: &Diktiometry, pair: &geometric::Pair, config: &Config) -> Option<Restructurer> {
    let mut proposed = None;
    for (restructurer, opinion) in RESTRUCTURERS {
        match opinion(map, pair, config) {
            Verdict::Propose => proposed = proposed.or(Some(restructurer)),
            Verdict::Abstain => {}
            Verdict::Reject => return None,
        }
    }
    proposed
}

/// Places whose changes may settle an open decision.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Hints {
    /// Places whose relations to their neighbours changed.
    pub(super) changed: Vec<PlaceId>,
    /// Places near enough that a change may narrow the box between them and another.
    pub(super) near: Vec<PlaceId>,
}

impl Hints {
    /// Takes the next place, and whether it changed itself. Places that did come first.
    fn next(&mut self) -> Option<(PlaceId, bool)> {
        let changed = self.changed.pop().map(|place| (place, true));
        changed.or_else(|| Some((self.near.pop()?, false)))
    }
}

/// Restructures the map where the updater hints, and where this in turn changes something. Returns
/// the changes. "It can be advantageous for the updater to inform the restructuring module when it
/// performs an update". Places with tracks (`occupied`) are never elided.
pub(super) fn restructure(
    map: &mut Diktiometry,
    config: &Config,
    mut hints: Hints,
    occupied: &[PlaceId],
    distinctions: &[Distinction],
) -> Vec<Restructured> {
    let mut done = Vec::new();
    // What was just split is not merged in the same call, so that this ends. Every round but the
    // first makes a merge, and merges use up the places.
    let mut born: Vec<PlaceId> = Vec::new();
    while let Some((hint, changed)) = hints.next() {
        let Some(place) = map.paths.resolve(hint) else {
            continue;
        };
        let mut noted = if changed || geometric::is_nearness_noted(map, place) {
            geometric::noted(map, place, config)
        } else {
            look_agreement::noted(map, place, config)
        };
        let mut near = Vec::new();
        if changed {
            done.extend(transients::elide(map, place, occupied, config));
            near = geometric::around(map, place);
            noted.extend(winding::round(map, place, config));
            noted.extend(one_way::doubles(map, place, config));
        }
        for pair in noted.into_iter().chain(geometric::meeting(&near)) {
            let may_merge =
                |place| map.place(place).fate == Fate::Standing && !born.contains(&place);
            if !may_merge(pair.a)
                || !may_merge(pair.b)
                || distinctions.iter().any(|one| separates(map, one, &pair))
            {
                continue;
            }
            if let Some(by) = accepted(map, &pair, config)
                && let Some(kept) = merge::merge(map, &pair, config)
            {
                let merged = if kept == pair.a { pair.b } else { pair.a };
                done.push(Restructured::Merged { kept, merged, by });
                hints.changed.push(kept);
            }
        }
        let stands = map.place(place).fate == Fate::Standing;
        if changed
            && stands
            && let Some(diagnosis) = split_diagnosis(map, place, config)
        {
            let new = split::split(map, place, &diagnosis);
            let by = diagnosis.by();
            done.push(Restructured::Split {
                kept: place,
                new,
                by,
            });
            born.push(new);
        }
    }
    done
}

/// Returns whether a pair of places is known to be different.
fn separates(map: &Diktiometry, distinction: &Distinction, pair: &geometric::Pair) -> bool {
    let ends = [distinction.one, distinction.other].map(|end| map.paths.resolve(end));
    ends == [Some(pair.a), Some(pair.b)] || ends == [Some(pair.b), Some(pair.a)]
}

impl Diagnosis {
    const fn by(&self) -> Restructurer {
        match self {
            Self::Estims { .. } => Restructurer::Geometry,
            Self::Links { .. } => Restructurer::LocalPath,
        }
    }
}

/// Function that gives an opinion on whether two places are one.
type Opinion = fn(&Diktiometry, &geometric::Pair, &Config) -> Verdict;

/// Restructurers in the order in which they are asked, until one rejects.
const RESTRUCTURERS: [(Restructurer, Opinion); 7] = [
    (Restructurer::Geometry, geometric::merge),
    (Restructurer::Looks, views_differ),
    (Restructurer::OneWay, one_way::merge),
    (Restructurer::Winding, winding::merge),
    (Restructurer::LocalPath, local_path::merge),
    (Restructurer::NonLocalPath, non_local_path::merge),
    (Restructurer::Looks, look_agreement::merge),
];

/// Rejects places that look different. Exception: a place without room for another may look new and
/// is the same.
fn views_differ(map: &Diktiometry, pair: &geometric::Pair, config: &Config) -> Verdict {
    let [a, b] = [pair.a, pair.b].map(|place| map.place(place));
    let settled = || {
        config.restructuring.geometric_merge == GeometricMerge::Narrow
            && geometric::merge(map, pair, config) == Verdict::Propose
    };
    if share_a_view(a, b, &config.percepts) || settled() {
        Verdict::Abstain
    } else {
        Verdict::Reject
    }
}

/// Returns the proposal to split a place. Neither restructurer has grounds to reject the other's:
/// places at one point may behave differently, and places that behave alike may be apart.
fn split_diagnosis(map: &Diktiometry, place: PlaceId, config: &Config) -> Option<Diagnosis> {
    geometric::split(map, place, config).or_else(|| local_path::split(map, place, config))
}
