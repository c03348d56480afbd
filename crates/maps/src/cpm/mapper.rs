use alloc::vec::Vec;

use super::config::{Candidates, CpMapperConfig};
use super::map::{CpMap, End, Fragment, FragmentId, Junction, Port, PortState};
use super::pattern::{Dictionary, PatternId};
use super::scores::Scores;
use super::similarity::{Matching, Sense};
use super::traversal::{Sighting, Traversal};
use super::turn::{NoSuchTurn, Turn};
use super::unify::Merges;

/// A map and where on it the robot is.
#[derive(Clone, Debug)]
pub(super) struct Mapper {
    pub(super) map: CpMap,
    /// The port behind the robot.
    pub(super) at: Port,
}

/// What a walk was, as far as the map knew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Walked {
    /// Through an open port.
    New(FragmentId),
    /// Along a fragment of the map, which led where it should.
    Known,
    /// Along a fragment of the map, which turned out to be another: the map is wrong somewhere, or what was sighted is.
    Contradicted(FragmentId),
}

impl Mapper {
    pub(super) fn new(start: Sighting) -> Self {
        let mut map = CpMap::default();
        let junction = map.add_junction(start, None);
        let at = junction.port(0);
        Self { map, at }
    }

    /// Takes in a walk. What is new is joined to the last junction, "together with the performed transition"; the junction
    /// it led to is new as well, until unified with another.
    pub(super) fn walk(
        &mut self,
        exit: Port,
        walk: &Traversal,
        trust: impl Fn(&CpMap, &Fragment, Sense) -> bool,
    ) -> Walked {
        let Some(end) = self.map.end_at(exit) else {
            return Walked::New(self.append(exit, walk));
        };
        let sense = Sense::entered_at(end.sign);
        let expected = self.map.beyond(exit);
        let place = expected.and_then(|port| self.map.junction(port.junction));
        let known = self.map.fragment(end.fragment);
        if let (Some(place), Some(known), Some(port)) = (place, known, expected)
            && place.sighting() == walk.sighting
            && trust(&self.map, known, sense)
        {
            self.at = port;
            self.confirm(end, walk);
            return Walked::Known;
        }
        Walked::Contradicted(self.go_adrift(exit, walk))
    }

    /// The robot is not where the map has it. What it has walked begins at a copy of its place that hangs on nothing, until it is
    /// recognized; the port stays as it is.
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

    pub(super) fn append(&mut self, exit: Port, walk: &Traversal) -> FragmentId {
        let junction = self.map.add_junction(walk.sighting, walk.bearings.clone());
        self.at = junction.port(0);
        self.map
            .add_fragment(walk.patterns.clone(), walk.motion, exit, self.at)
    }

    /// The robot has come along a fragment to where it is now.
    pub(super) fn confirm(&mut self, end: End, walk: &Traversal) {
        self.notice(walk);
        let Some(fragment) = self.map.fragments.get_mut(end.fragment) else {
            return;
        };
        fragment.traversals = fragment.traversals.saturating_add(1);
        let sense = Sense::entered_at(end.sign);
        let motion = walk.motion.map(|motion| sense.of_motion(motion));
        // Bounds that contradict each other were no bounds; the older ones stay.
        fragment.motion = match (fragment.motion, motion) {
            (Some(a), Some(b)) => a.intersection(b).or(Some(a)),
            (a, b) => a.or(b),
        };
    }

    /// The robot has come to where it is now, and has seen its ways out.
    pub(super) fn notice(&mut self, walk: &Traversal) {
        if let Some(place) = self.map.junctions.get_mut(self.at.junction) {
            place.notice(self.at.number, walk.bearings.as_ref());
        }
    }

    /// The robot has turned round in a fragment and is back, after so many observations in it.
    pub(super) fn came_back(&mut self, exit: Port, observations: u32) {
        if let Some(PortState::Open { at_least }) = self.map.port_state_mut(exit) {
            *at_least = observations.max(*at_least);
        }
        self.at = exit;
    }

    /// The port that a turn leads to.
    pub(super) fn exit(&self, turn: Turn) -> Result<Port, NoSuchTurn> {
        let Port { junction, number } = self.at;
        let degree = self.map.degree(junction);
        Ok(junction.port(turn.exit(number, degree)?))
    }

    /// The fragment that another one is a duplicate of: the most similar one with which it can be unified, which it then is.
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

    /// "The robot repeats checking the similar A-Pattern and fills the new path-fragments to the junction … until no similar
    /// pattern remains." Returns how many were found to be duplicates.
    pub(super) fn optimize(&mut self, comparison: &Comparison<'_>) -> usize {
        let before = self.map.fragments.len();
        let ids: Vec<FragmentId> = self.map.fragments().map(|(id, _)| id).collect();
        for id in ids {
            while self.unify_with_similar(id, comparison).is_some() {}
        }
        before - self.map.fragments.len()
    }
}

/// What fragments are compared by, and what came of it.
#[derive(Debug)]
pub(super) struct Comparison<'a> {
    pub(super) matching: &'a Matching,
    pub(super) candidates: Candidates,
    pub(super) dictionary: &'a Dictionary,
    pub(super) scores: Scores,
}

impl Comparison<'_> {
    /// How similar two sequences are, the second walked as the sense says.
    pub(super) fn score(&self, one: &[PatternId], other: &[PatternId], sense: Sense) -> f64 {
        let compute = || self.matching.score_as(self.dictionary, one, other, sense);
        self.scores.of(one, other, sense, compute)
    }

    /// The fragments to compare one of the map with.
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
        match candidates {
            None => map.fragments().filter(|(id, _)| *id != one).collect(),
            Some(ids) => {
                let found = ids.into_iter().filter(|id| *id != one);
                found
                    .filter_map(|id| Some((id, map.fragment(id)?)))
                    .collect()
            }
        }
    }
}

/// How an online robot judges a fragment that it knows: it trusts the map unless another fragment fits what it has observed, and
/// this one does not.
pub(super) fn trusts(
    config: &CpMapperConfig,
    dictionary: &Dictionary,
    map: &CpMap,
    walk: &Traversal,
    known: &Fragment,
    sense: Sense,
) -> bool {
    let matching = &config.matching;
    matching.agrees(dictionary, &walk.patterns, &known.patterns, sense)
        || map.fragments().all(|(_, other)| {
            matching
                .matches(dictionary, &walk.patterns, &other.patterns)
                .is_none()
        })
}
