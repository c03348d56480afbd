use alloc::vec::Vec;

use super::matcher::find;
use crate::diktiometry::{Candidate, Matcher, PlaceId, Similarity, Situation};

/// Decision of the matching engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Choice {
    /// The maximal applicable matchers, the best first; never empty.
    pub(crate) matches: Vec<Chosen>,
    /// Places at which the robot may be, but whose boxes are too wide to decide.
    pub(crate) doubts: Vec<PlaceId>,
    /// Places, beside the best match, where the robot certainly is: they are the same place.
    pub(crate) twins: Vec<PlaceId>,
    /// An expected place, if none was met. It is excluded by its position or by its look.
    pub(crate) excluded: Option<Candidate>,
    /// Whether the best match looks as before.
    pub(crate) look: Similarity,
    /// Whether another match would be best by the static order.
    pub(crate) reordered: bool,
}

/// A matcher and the place it matched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chosen {
    pub(crate) matcher: Matcher,
    /// Matched place; `None` for a new place.
    pub(crate) candidate: Option<Candidate>,
    pub(super) look: Similarity,
    /// Whether the robot can be at no other place: no other is near enough, or none has the robot's
    /// view.
    pub(super) is_certain: bool,
}

impl Chosen {
    const NEW_PLACE: Self = Self {
        matcher: Matcher::NewPlace,
        candidate: None,
        look: Similarity::Alike,
        is_certain: false,
    };

    pub(crate) fn place(&self) -> Option<PlaceId> {
        self.candidate.map(|candidate| candidate.place)
    }

    /// Returns whether the match posits no error of the map.
    fn is_normal(&self) -> bool {
        matches!(self.matcher, Matcher::Continue | Matcher::Link)
    }

    /// Returns the squared distance from the robot to the middle of the place, m².
    fn distance(&self) -> f64 {
        self.candidate.map_or(0.0, |candidate| {
            let middle = candidate.offset.middle();
            middle.x * middle.x + middle.y * middle.y
        })
    }

    fn visits(&self, situation: &Situation<'_>) -> u32 {
        let place = self.place().map(|place| situation.map.place(place));
        place.map_or(0, |place| place.visits)
    }
}

/// Applies the matchers to the sets of candidates, the best set first, and returns the choice: "the
/// maximal applicable matchers are used … If no matchers apply, a new place is created."
///
/// `expected` is the first set. `plies` gives the sets of the other modules, and is called only if
/// no CONTINUE takes precedence over them. The first set with a match that posits no error wins. If
/// none has one, the first set with any match competes with a new place.
pub(crate) fn choose(
    situation: &Situation<'_>,
    expected: &[Candidate],
    plies: impl FnOnce() -> Vec<Vec<Candidate>>,
) -> Choice {
    let mut choice = Choice::default();
    let first = matched(situation, expected, &mut choice.doubts);
    if !first.iter().any(Chosen::is_normal) && choice.doubts.is_empty() {
        choice.excluded = expected.first().copied();
    }
    let mut continues = first.iter().filter(|one| one.matcher == Matcher::Continue);
    // Odometry excludes the place where the action always led: odometry is wrong.
    let is_there = |led| first.iter().any(|one| one.place() == Some(led));
    let is_led = !first.iter().any(Chosen::is_normal) && situation.led.is_some_and(is_there);
    // Where the robot can be at no other place, others could only turn out to be the same.
    let enough = is_led
        || if situation.precedes(Matcher::Continue, Matcher::Link, 0) {
            continues.next().is_some()
        } else {
            continues.any(|one| one.is_certain)
        };
    let mut sets = Vec::from([first]);
    if !enough {
        for mut ply in plies() {
            ply.retain(|one| expected.iter().all(|other| other.place != one.place));
            sets.push(matched(situation, &ply, &mut choice.doubts));
        }
    }
    // All that is certain beside the first is the same place once more.
    let all = sets.iter().flatten();
    let certain = all.filter(|one| one.is_normal() && one.is_certain);
    let certain: Vec<PlaceId> = certain.filter_map(Chosen::place).collect();

    // The first set is joined with the first of the others.
    if sets.len() > 1 {
        let joined = sets.remove(1);
        sets[0].extend(joined);
    }
    let applicable = applicable(&sets);
    choice.matches = maximal(situation, &applicable);
    if let Some(best) = choice.matches.first() {
        choice.reordered = applicable.iter().any(|one| one.matcher < best.matcher);
        choice.look = best.look;
        if best.is_certain {
            choice.twins = certain;
            choice.twins.retain(|place| Some(*place) != best.place());
        }
    }
    choice.doubts.sort_unstable();
    choice.doubts.dedup();
    choice
}

/// Returns the candidates of a set to which a matcher applies. Undecided ones go to `doubts`.
fn matched(situation: &Situation<'_>, set: &[Candidate], doubts: &mut Vec<PlaceId>) -> Vec<Chosen> {
    let found = set
        .iter()
        .map(|candidate| find(candidate, situation, doubts));
    found.flatten().collect()
}

/// Returns the matches without an error of the first set that has any. If none has, returns those
/// of the first set with any; these compete with a new place.
fn applicable(sets: &[Vec<Chosen>]) -> Vec<Chosen> {
    let normal = |set: &Vec<Chosen>| -> Vec<Chosen> {
        let all = set.iter().copied();
        all.filter(Chosen::is_normal).collect()
    };
    let mut normal = sets.iter().map(normal);
    normal.find(|set| !set.is_empty()).unwrap_or_else(|| {
        let posits_error = sets.iter().find(|set| !set.is_empty());
        let mut all = posits_error.cloned().unwrap_or_default();
        all.push(Chosen::NEW_PLACE);
        all
    })
}

/// Returns the best matches, those over which no other takes precedence.
fn maximal(situation: &Situation<'_>, applicable: &[Chosen]) -> Vec<Chosen> {
    let precedes = |other: &Chosen, one: &Chosen| {
        let grown = if other.matcher == Matcher::Alpha {
            other
        } else {
            one
        };
        situation.precedes(other.matcher, one.matcher, grown.visits(situation))
    };
    let maximal = |one: &&Chosen| !applicable.iter().any(|other| precedes(other, one));
    let mut matches: Vec<Chosen> = applicable.iter().filter(maximal).copied().collect();
    matches.sort_by(|a, b| {
        let nearest = a.distance().total_cmp(&b.distance());
        let matcher = a.matcher.cmp(&b.matcher);
        matcher.then(nearest).then(a.place().cmp(&b.place()))
    });
    matches
}
