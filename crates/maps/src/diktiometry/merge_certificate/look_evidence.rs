use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::{LookEvidence, LookPair};
use crate::diktiometry::{Agreeing, Config, Journal, Looks, Percepts, Signature, alike};

impl LookEvidence {
    /// Returns the evidence of one pair of visits, with a provisional probability of 1.
    pub(super) fn first(visits: [usize; 2], looks: Looks) -> Self {
        let after = None;
        Self {
            pairs: Vec::from([LookPair { visits, after }]),
            looks,
            chance: 1.0,
        }
    }

    /// Returns the probability that the agreement is a coincidence. It assumes as many candidate
    /// places as there are kinds of looks, plus two. `place` names the place of a visit.
    pub(super) fn stated(
        &self,
        config: &Config,
        journal: &Journal,
        place: impl Fn(usize) -> usize,
    ) -> f64 {
        let others = f64::from(self.looks.kinds) + 2.0;
        let chance = self.looks.chance(Agreeing {
            kinds: self.kinds(config, journal),
            places: self.places(place),
        });
        (others * chance).min(1.0)
    }

    /// Returns the number of pairs of places that are in no earlier pair.
    fn places(&self, place: impl Fn(usize) -> usize) -> usize {
        let mut paired = BTreeSet::new();
        let mut count = 0;
        for pair in &self.pairs {
            let [one, other] = pair.visits.map(&place);
            if !paired.contains(&one) && !paired.contains(&other) {
                paired.extend([one, other]);
                count += 1;
            }
        }
        count
    }

    /// Returns the number of different looks among the pairs.
    fn kinds(&self, config: &Config, journal: &Journal) -> usize {
        let mut kinds: Vec<usize> = Vec::new();
        for pair in &self.pairs {
            let [visit, _] = pair.visits;
            if kinds
                .iter()
                .all(|kind| !look_alike(*kind, visit, config, journal))
            {
                kinds.push(visit);
            }
        }
        kinds.len()
    }
}

/// Returns the signature seen at a visit, or `None` if the robot did not look.
pub(super) fn percept(visit: usize, journal: &Journal) -> Option<&Signature> {
    match visit.checked_sub(1) {
        None => journal.start.percept.as_ref(),
        Some(number) => journal.moves.get(number)?.percept.as_ref(),
    }
}

/// Returns whether two visits look alike; false if a look is missing.
pub(super) fn look_alike(one: usize, other: usize, config: &Config, journal: &Journal) -> bool {
    let Percepts::Signatures(kind) = &config.percepts else {
        return false;
    };
    let seen = percept(one, journal).zip(percept(other, journal));
    seen.is_some_and(|(one, other)| alike(one, other, kind))
}
