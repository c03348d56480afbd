use alloc::vec::Vec;

use super::matcher::{Applicable, Certainty, Finding, Look, find};
use super::order::{Age, Standing, Traversal, precedes};
use super::{Matcher, Situation};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::indexing::Candidate;

/// What the matching engine decided.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::diktiometry) struct Choice {
    /// The maximal applicable matchers, the best first; never empty.
    pub(in crate::diktiometry) matches: Vec<Chosen>,
    /// Places that the robot may be at, but the boxes are too wide to tell.
    pub(in crate::diktiometry) doubts: Vec<PlaceId>,
    /// Places that the robot is at for certain, beside the best match: they are one with it.
    pub(in crate::diktiometry) twins: Vec<PlaceId>,
    /// A place that was expected, where none of those was met: by its position or by its look.
    pub(in crate::diktiometry) excluded: Option<Candidate>,
    /// Whether the best match looks as it did.
    pub(in crate::diktiometry) look: Look,
}

/// A matcher and the place it matched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::diktiometry) struct Chosen {
    pub(in crate::diktiometry) matcher: Matcher,
    /// None for a new place.
    pub(in crate::diktiometry) candidate: Option<Candidate>,
    look: Look,
    certainty: Certainty,
}

impl Chosen {
    const NEW_PLACE: Self = Self {
        matcher: Matcher::NewPlace,
        candidate: None,
        look: Look::Known,
        certainty: Certainty::Uncertain,
    };

    fn is_certain(&self) -> bool {
        self.certainty == Certainty::Certain
    }
}

/// Applies the matchers to the sets of candidates, the best set first: "the maximal applicable matchers are used … If no
/// matchers apply, a new place is created."
///
/// `expected` is the first set; `plies` gives the sets of the other modules, asked for only where no CONTINUE takes precedence over
/// all they could bring. The first set with a match that posits no error wins; only if there is none, the first with
/// one that does stands against a new place.
pub(in crate::diktiometry) fn choose(
    situation: &Situation<'_>,
    traversed: Traversal,
    confidence: f64,
    expected: &[Candidate],
    plies: impl FnOnce() -> Vec<Vec<Candidate>>,
) -> Choice {
    let mut choice = Choice::default();
    let standing = |age| Standing {
        traversed,
        confidence,
        age,
    };
    let tracking = &situation.config.tracks;
    let order = situation.config.matching.order;
    let rank = |a: Matcher, b: Matcher, age: Age| precedes(a, b, &standing(age), tracking, order);

    let first = matched(situation, expected, &mut choice.doubts);
    let is_normal = |one: &&Chosen| matches!(one.matcher, Matcher::Continue | Matcher::Link);
    if !first.iter().any(|one| is_normal(&one)) && choice.doubts.is_empty() {
        choice.excluded = expected.first().copied();
    }
    let mut continues = first.iter().filter(|one| one.matcher == Matcher::Continue);
    // Where the robot can be at no other place, others could only turn out to be the same.
    let enough = if rank(Matcher::Continue, Matcher::Link, Age::Old) {
        continues.next().is_some()
    } else {
        continues.any(Chosen::is_certain)
    };
    let mut sets = Vec::from([first]);
    if !enough {
        for mut ply in plies() {
            ply.retain(|one| expected.iter().all(|other| other.place != one.place));
            sets.push(matched(situation, &ply, &mut choice.doubts));
        }
    }
    // All that is certain beside the first is the same place once more.
    let certain: Vec<PlaceId> = sets
        .iter()
        .flatten()
        .filter(is_normal)
        .filter(|one| one.is_certain())
        .filter_map(|one| one.candidate)
        .map(|candidate| candidate.place)
        .collect();

    // The first set is joined with the first of the others.
    if sets.len() > 1 {
        let joined = sets.remove(1);
        sets[0].extend(joined);
    }
    let normal = sets
        .iter()
        .map(|set| set.iter().filter(is_normal).copied().collect::<Vec<_>>())
        .find(|set| !set.is_empty());
    let applicable = normal.unwrap_or_else(|| {
        let posits_error = sets.into_iter().find(|set| !set.is_empty());
        let mut all = posits_error.unwrap_or_default();
        all.push(Chosen::NEW_PLACE);
        all
    });
    let age = |one: &Chosen| {
        let visits = one.candidate.map_or(0, |candidate| {
            situation.map.paths.places[candidate.place.index()].visits
        });
        if visits < situation.config.matching.alpha_visits {
            Age::Young
        } else {
            Age::Old
        }
    };
    choice.matches = applicable
        .iter()
        .filter(|one| {
            let preceded = |other: &Chosen| {
                let age = if other.matcher == Matcher::Alpha {
                    age(other)
                } else {
                    age(one)
                };
                rank(other.matcher, one.matcher, age)
            };
            !applicable.iter().any(preceded)
        })
        .copied()
        .collect();
    choice.matches.sort_by(|a, b| {
        let distance = |one: &Chosen| {
            one.candidate.map_or(0.0, |candidate| {
                let middle = candidate.offset.middle();
                middle.x * middle.x + middle.y * middle.y
            })
        };
        let place = |one: &Chosen| one.candidate.map(|candidate| candidate.place);
        let nearest = distance(a).total_cmp(&distance(b));
        let matcher = a.matcher.cmp(&b.matcher);
        matcher.then(nearest).then(place(a).cmp(&place(b)))
    });
    if let Some(best) = choice.matches.first() {
        choice.look = best.look;
        if best.is_certain() {
            choice.twins = certain;
            let itself = best.candidate.map(|candidate| candidate.place);
            choice.twins.retain(|place| Some(*place) != itself);
        }
    }
    choice.doubts.sort_unstable();
    choice.doubts.dedup();
    choice
}

/// The candidates of a set that a matcher applies to; those that none can tell go to `doubts`.
fn matched(situation: &Situation<'_>, set: &[Candidate], doubts: &mut Vec<PlaceId>) -> Vec<Chosen> {
    set.iter()
        .filter_map(|candidate| {
            let Finding {
                applicable,
                look,
                certainty,
            } = find(candidate, situation);
            match applicable {
                Applicable::Matcher(matcher) => Some(Chosen {
                    matcher,
                    candidate: Some(*candidate),
                    look,
                    certainty,
                }),
                Applicable::Doubtful => {
                    doubts.push(candidate.place);
                    None
                }
                Applicable::None => None,
            }
        })
        .collect()
}
