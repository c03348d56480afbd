use alloc::vec::Vec;

use tolman_geom::{Interval, PointBox};

use super::{Identities, JournalSpan, WindingEvidence, box_of, connect};
use crate::diktiometry::{
    Action, Chain, Config, Corridors, Exits, Journal, Turns, is_rectangle, winding::ROUND,
};

/// Known corners are named by visits that represent their classes.
pub(super) struct KnownCorridors<'a> {
    pub(super) identities: &'a Identities<'a>,
    pub(super) journal: &'a Journal,
}

impl Corridors for KnownCorridors<'_> {
    type Place = usize;

    fn exits(&self, visit: usize) -> &Exits {
        exits(visit, self.journal)
    }

    fn leads(&self, from: usize, action: Action) -> Option<usize> {
        self.identities.leads(from, action)
    }
}

/// Returns the actions that the robot saw to be possible at a visit.
pub(super) fn exits(visit: usize, journal: &Journal) -> &Exits {
    match visit.checked_sub(1) {
        None => &journal.start.exits,
        Some(number) => journal
            .moves
            .get(number)
            .map_or(&Exits::Unknown, |step| &step.exits),
    }
}

impl WindingEvidence {
    /// Returns the evidence of a chain of corners, or `None` if its lengths fit a spiral.
    /// `routes` gives the known routes between two visits.
    pub(super) fn of(
        chain: &Chain<usize>,
        config: &Config,
        journal: &Journal,
        mut routes: impl FnMut([usize; 2]) -> Vec<Vec<JournalSpan>>,
    ) -> Option<Self> {
        let ends = chain.corners.windows(2);
        let evidence = Self {
            corners: chain.corners.clone(),
            begins: [0, 1].map(|corner| chain.turns.action(corner)),
            corridors: ends.map(|ends| routes([ends[0], ends[1]])).collect(),
        };
        let boxes = evidence.corridors.iter();
        let boxes = boxes.map(|routes| box_of(routes, &journal.moves, config));
        let boxes: Option<Vec<PointBox>> = boxes.collect();
        evidence.is_round(&boxes?, config).then_some(evidence)
    }

    /// Returns whether no spiral has corridors in these boxes.
    pub(super) fn is_round(&self, boxes: &[PointBox], config: &Config) -> bool {
        let Some(turns) = Turns::new(self.begins, config) else {
            return false;
        };
        let lengths = boxes.iter().enumerate();
        let lengths = lengths.map(|(corner, way)| turns.length(corner, *way, config));
        is_rectangle(&lengths.collect::<Vec<Interval>>(), config)
    }

    /// Returns the first visit that is not to a corner of the chain, or `None` if all are.
    pub(super) fn no_corner(&self, config: &Config, journal: &Journal) -> Option<usize> {
        let turns = Turns::new(self.begins, config);
        let fits =
            |corner, visit| turns.is_some_and(|turns| turns.fit(corner, exits(visit, journal)));
        let mut corners = self.corners.iter().enumerate();
        corners.find_map(|(corner, visit)| (!fits(corner, *visit)).then_some(*visit))
    }

    /// Returns whether the corners, by known identities, are joined by their corridors, and
    /// two visits are a round apart.
    pub(super) fn joins(
        &self,
        [one, other]: [usize; 2],
        identities: &Identities<'_>,
        config: &Config,
    ) -> bool {
        let Some(turns) = Turns::new(self.begins, config) else {
            return false;
        };
        let ends = self.corners.windows(2);
        let mut corridors = ends.zip(&self.corridors).enumerate();
        let are_joined = corridors.all(|(corner, (ends, routes))| {
            let to = identities.leads(ends[0], turns.action(corner));
            to.is_some_and(|to| identities.same(to, ends[1]))
                && connect([ends[0], ends[1]], routes, identities)
        });
        let mut rounds = self.corners.iter().zip(self.corners.iter().skip(ROUND));
        let is_round = rounds.any(|(begin, end)| {
            let fits = |one, other| identities.same(one, *begin) && identities.same(other, *end);
            fits(one, other) || fits(other, one)
        });
        self.corners.len() == self.corridors.len() + 1 && are_joined && is_round
    }

    /// Returns all visits that the evidence names.
    pub(super) fn visits(&self) -> impl Iterator<Item = usize> {
        let spans = self.corridors.iter().flatten().flatten();
        let ends = spans.flat_map(|span| [span.begin, span.end]);
        self.corners.iter().copied().chain(ends)
    }
}
