use alloc::vec::Vec;

use super::config::Candidates;
use super::map::{CpMap, End, Fragment, FragmentId, Junction, Port, PortState};
use super::pattern::{Dictionary, PatternId};
use super::scores::Scores;
use super::similarity::{FragmentMatching, Sense};
use super::traversal::{Sighting, Traversal};
use super::turn::{NoSuchTurn, Turn};
use super::unify::Merges;

/// A map and the robot's place on it.
#[derive(Clone, Debug)]
pub(super) struct Mapper {
    pub(super) map: CpMap,
    /// The port behind the robot.
    pub(super) at: Port,
}

impl Mapper {
    pub(super) fn new(start: Sighting) -> Self {
        let mut map = CpMap::default();
        let junction = map.add_junction(start, None);
        let at = junction.port(0);
        Self { map, at }
    }

    /// Takes in a walk if it is along a known fragment, leads where the map says, and is trusted.
    /// Returns whether it is.
    pub(super) fn follow(
        &mut self,
        exit: Port,
        walk: &Traversal,
        judge: Option<&Comparison<'_>>,
    ) -> bool {
        let map = &self.map;
        let Some((end, port)) = map.end_at(exit).zip(map.beyond(exit)) else {
            return false;
        };
        let place = map.junction(port.junction);
        let is_expected = place.is_some_and(|place| place.sighting() == walk.sighting)
            && judge.is_none_or(|judge| judge.trusts(map, walk, end));
        if is_expected {
            self.at = port;
            self.confirm(end, walk);
        }
        is_expected
    }

    /// Starts a new part of the map, because the robot is not where the map has it. The new part
    /// begins at an unconnected copy of the place, until the place is recognized. The port stays
    /// the same.
    pub(super) fn go_adrift(&mut self, exit: Port, walk: &Traversal) -> FragmentId {
        let place = self.map.junction(exit.junction);
        let sighting = place.map(Junction::sighting);
        let bearings = place.and_then(|place| place.bearings_from(self.at.number));
        let degree = sighting.map_or(1, |sighting| sighting.degree);
        let turn = Turn::between(self.at.number, exit.number, degree).unwrap_or(Turn::BACK);
        let landmark = None;
        let adrift = self
            .map
            .add_junction(sighting.unwrap_or(Sighting { degree, landmark }), bearings);
        self.append(adrift.port(turn.0), walk)
    }

    /// Adds the walk as a new fragment from `exit`, "together with the performed transition". The
    /// junction at its end is new as well, until it is unified with another.
    pub(super) fn append(&mut self, exit: Port, walk: &Traversal) -> FragmentId {
        let junction = self.map.add_junction(walk.sighting, walk.bearings.clone());
        self.at = junction.port(0);
        self.map
            .add_fragment(walk.patterns.clone(), walk.motion, exit, self.at)
    }

    /// Takes in a walk along a known fragment, entered at `end`.
    pub(super) fn confirm(&mut self, end: End, walk: &Traversal) {
        self.notice(walk);
        let Some(fragment) = self.map.fragments.get_mut(end.fragment) else {
            return;
        };
        fragment.traversals = fragment.traversals.saturating_add(1);
        let sense = Sense::entered_at(end.sign);
        let motion = walk.motion.map(|motion| sense.of_motion(motion));
        // Bounds that contradict each other are invalid; the older ones stay.
        fragment.motion = match (fragment.motion, motion) {
            (Some(a), Some(b)) => a.intersection(b).or(Some(a)),
            (a, b) => a.or(b),
        };
    }

    /// Takes in the ways out seen at the robot's present place.
    pub(super) fn notice(&mut self, walk: &Traversal) {
        if let Some(place) = self.map.junctions.get_mut(self.at.junction) {
            place.notice(self.at.number, walk.bearings.as_ref());
        }
    }

    /// Notes that the robot has turned round in a fragment after `observations` observations, and
    /// is back.
    pub(super) fn came_back(&mut self, exit: Port, observations: u32) {
        if let Some(PortState::Open { at_least }) = self.map.port_state_mut(exit) {
            *at_least = observations.max(*at_least);
        }
        self.at = exit;
    }

    /// Returns the port that a turn leads to.
    pub(super) fn exit(&self, turn: Turn) -> Result<Port, NoSuchTurn> {
        let Port { junction, number } = self.at;
        let degree = self.map.degree(junction);
        Ok(junction.port(turn.exit(number, degree)?))
    }

    /// Unifies a fragment with the most similar one that it can duplicate. Returns the merges, or
    /// `None` if there is no such fragment.
    pub(super) fn unify_with_similar(
        &mut self,
        new: FragmentId,
        comparison: &Comparison<'_>,
    ) -> Option<Merges> {
        let Comparison {
            matching,
            dictionary,
            ..
        } = comparison;
        let fragment = self.map.fragment(new)?;
        let mut similar: Vec<(f64, FragmentId, Sense)> = Vec::new();
        for (id, other) in comparison.others(&self.map, new) {
            let found = matching.matches(dictionary, &fragment.patterns, &other.patterns);
            similar.extend(found.map(|found| (found.score, id, found.sense)));
        }
        // The sort is stable: of equals the older first.
        similar.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
        let agree = |a: &Fragment, b: &Fragment, sense: Sense| {
            let score = matching.score_as(dictionary, &a.patterns, &b.patterns, sense);
            score > matching.threshold_at_port()
        };
        similar.into_iter().find_map(|(_, other, sense)| {
            let (map, merges) = self.map.unified(new, other, sense, &agree)?;
            self.map = map;
            self.at = merges.port(self.at);
            Some(merges)
        })
    }

    /// Unifies duplicates until none is left and returns how many there were. "The robot repeats
    /// checking the similar A-Pattern and fills the new path-fragments to the junction … until no
    /// similar pattern remains."
    pub(super) fn optimize(&mut self, comparison: &Comparison<'_>) -> usize {
        let before = self.map.fragments.len();
        let ids: Vec<FragmentId> = self.map.fragments().map(|(id, _)| id).collect();
        for id in ids {
            while self.unify_with_similar(id, comparison).is_some() {}
        }
        before - self.map.fragments.len()
    }
}

/// Comparison of fragments, with the results so far.
#[derive(Debug)]
pub(super) struct Comparison<'a> {
    pub(super) matching: &'a FragmentMatching,
    pub(super) candidates: Candidates,
    pub(super) dictionary: &'a Dictionary,
    pub(super) scores: Scores,
}

impl Comparison<'_> {
    /// Returns the similarity of two sequences, the second walked in the given sense.
    pub(super) fn score(&self, one: &[PatternId], other: &[PatternId], sense: Sense) -> f64 {
        let compute = || self.matching.score_as(self.dictionary, one, other, sense);
        self.scores.of(one, other, sense, compute)
    }

    /// Returns the fragments that may duplicate a fragment of the map.
    pub(super) fn others<'m>(
        &self,
        map: &'m CpMap,
        one: FragmentId,
    ) -> Vec<(FragmentId, &'m Fragment)> {
        let patterns = map
            .fragment(one)
            .map_or(&[][..], |fragment| &fragment.patterns);
        let candidates = match self.candidates {
            Candidates::All => None,
            // It finds the fragment itself as well.
            Candidates::Best(most) => {
                map.index
                    .candidates(self.dictionary, patterns, most as usize + 1)
            }
        };
        let mut others: Vec<(FragmentId, &Fragment)> = match candidates {
            None => map.fragments().collect(),
            Some(ids) => {
                let found = ids.into_iter();
                found
                    .filter_map(|id| Some((id, map.fragment(id)?)))
                    .collect()
            }
        };
        others.retain(|(id, _)| *id != one);
        others
    }

    /// Returns whether an online robot identifies the walk with the known fragment that it entered
    /// at `end`. It does, unless another fragment fits the observations and this one does not.
    fn trusts(&self, map: &CpMap, walk: &Traversal, end: End) -> bool {
        let Self {
            matching,
            dictionary,
            ..
        } = self;
        let sense = Sense::entered_at(end.sign);
        let known = map.fragment(end.fragment);
        let agrees =
            |known: &Fragment| matching.agrees(dictionary, &walk.patterns, &known.patterns, sense);
        let differs = |other: &Fragment| {
            let found = matching.matches(dictionary, &walk.patterns, &other.patterns);
            found.is_none()
        };
        known.is_some_and(agrees) || map.fragments().all(|(_, other)| differs(other))
    }
}
