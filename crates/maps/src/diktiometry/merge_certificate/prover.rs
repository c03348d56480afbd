use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::look_evidence::look_alike;
use super::verifier::least_distance;
use super::winding_evidence::KnownCorridors;
use super::{
    Constraints, Identities, JournalSpan, LONGEST, LookEvidence, LookPair, MergeCertificate,
    MergeProof, WindingEvidence, box_of, connect,
};
use crate::diktiometry::{
    Chain, Config, Journal, JournalError, Looks, MoveOutcome, Observer, PlaceId, Restructured,
    StepReport,
};

/// Certificates for the merges of a map.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CertifiedMerges {
    /// Certificates in the order of the merges. Each rests on those before it.
    pub certificates: Vec<MergeCertificate>,
    /// Visits that the map identifies without a certificate.
    pub unproven: Vec<[usize; 2]>,
}

/// Goes through a journal as an observer does, and certifies each identity that the observer
/// claimed. In a static world, a way gone before needs no certificate.
///
/// O(moves) and, for each certificate, O(places · ways).
///
/// # Errors
/// [`JournalError`] if the journal does not fit the configuration.
pub fn certify_merges(config: &Config, journal: &Journal) -> Result<CertifiedMerges, JournalError> {
    let mut observer = Observer::new(config.clone(), journal.start.clone())?;
    observer
        .journal
        .distinctions
        .clone_from(&journal.distinctions);
    let mut prover = Prover {
        config,
        journal,
        identities: Identities::new(config),
        proven: Identities::new(config),
        constraints: Constraints::default(),
        views: BTreeMap::from([(0, Vec::from([0]))]),
        visits: BTreeMap::from([(observer.place(), 0)]),
        said: CertifiedMerges::default(),
    };
    for (number, step) in (1..).zip(&journal.moves) {
        let told = observer.step(step);
        let report = told.map_err(|source| JournalError::Move { number, source })?;
        match step.outcome {
            MoveOutcome::Blocked => prover.stay(),
            MoveOutcome::Arrived => prover.follow(number, &observer, &report),
        }
    }
    Ok(prover.said)
}

struct Prover<'a> {
    config: &'a Config,
    journal: &'a Journal,
    identities: Identities<'a>,
    /// Identities that do not rest on looks.
    proven: Identities<'a>,
    constraints: Constraints,
    /// Visits of each class that look different.
    views: BTreeMap<usize, Vec<usize>>,
    /// First visit to each place of the map.
    visits: BTreeMap<PlaceId, usize>,
    said: CertifiedMerges,
}

impl Prover<'_> {
    fn stay(&mut self) {
        self.identities.stay();
        self.proven.stay();
    }

    fn follow(&mut self, visit: usize, observer: &Observer, report: &StepReport) {
        let action = self.journal.moves[visit - 1].action;
        let joined = self.identities.arrive(action);
        self.proven.arrive(action);
        self.views.insert(visit, Vec::from([visit]));
        self.rename(joined);
        self.measure(visit);
        let looks = Looks {
            noted: 0,
            least_wanted: None,
            ..observer.map().looks
        };
        let mut open = self.claims(visit, observer, report);
        // One may rest on another.
        loop {
            let before = open.len();
            open.retain(|claim| !self.settle(claim, looks));
            if open.is_empty() || open.len() == before {
                break;
            }
        }
        self.said
            .unproven
            .extend(open.into_iter().filter_map(|claim| claim.last().copied()));
    }

    /// Returns the identities that the map claims after a move. Each claim is several pairs of
    /// visits, one of which is enough.
    fn claims(
        &mut self,
        visit: usize,
        observer: &Observer,
        report: &StepReport,
    ) -> Vec<Vec<[usize; 2]>> {
        let here = observer.place();
        let mut arrived = BTreeSet::from([here]);
        let mut merges = Vec::new();
        for change in &report.restructured {
            match *change {
                Restructured::Merged { kept, merged, .. } => {
                    arrived.extend([kept, merged]);
                    merges.push([kept, merged]);
                }
                // What leaves a place has been visited as that place.
                Restructured::Split { kept, new, .. } => {
                    if let Some(visit) = self.visits.get(&kept) {
                        self.visits.insert(new, *visit);
                    }
                }
                _ => {}
            }
        }
        // A place that was not visited before is the one that the move made.
        let is_new = arrived.iter().any(|place| !self.visits.contains_key(place));
        for place in &arrived {
            self.visits.entry(*place).or_insert(visit);
        }
        let pair = |[kept, merged]: [PlaceId; 2]| [self.visits[&kept], self.visits[&merged]];
        let pairs = merges.into_iter().map(pair);
        // A place that left another and comes back claims nothing.
        let mut claims: Vec<Vec<[usize; 2]>> = pairs
            .filter(|[one, other]| one != other)
            .map(|pair| Vec::from([pair]))
            .collect();
        let at = arrived
            .iter()
            .filter(|place| observer.map().paths.resolve(**place) == Some(here));
        let at: Vec<[usize; 2]> = at.map(|place| [self.visits[place], visit]).collect();
        let is_known_way = at
            .iter()
            .any(|[one, other]| self.identities.same(*one, *other));
        if !is_new && !is_known_way {
            claims.insert(0, at);
        }
        claims
    }

    /// Returns whether a claim is known to be true by now.
    fn settle(&mut self, claim: &[[usize; 2]], looks: Looks) -> bool {
        let certificate = claim.iter().find_map(|pair| self.by_bounds(*pair));
        let certificate =
            certificate.or_else(|| claim.iter().find_map(|pair| self.by_winding(*pair)));
        let certificate =
            certificate.or_else(|| claim.iter().find_map(|pair| self.by_looks(*pair, looks)));
        let Some(certificate) = certificate else {
            return false;
        };
        let [one, other] = certificate.visits;
        if !certificate.rests_on_looks {
            self.proven.join(one, other);
        }
        self.said.certificates.push(certificate);
        let joined = self.identities.join(one, other);
        self.rename(joined);
        true
    }

    fn by_bounds(&mut self, pair: [usize; 2]) -> Option<MergeCertificate> {
        let visits = self.alike(pair).unwrap_or(pair);
        let [from, to] = pair.map(|visit| self.identities.find(visit));
        let routes = self.constraints.routes(from, to);
        let between = box_of(&routes, &self.journal.moves, self.config)?;
        let least = least_distance(visits, self.config, self.journal);
        let rests_on_looks = !connect(visits, &routes, &self.proven);
        let proof = MergeProof::Bounds(routes);
        (self.config.apart.most(between) < least)
            .then(|| MergeCertificate::sealed(visits, proof, rests_on_looks))
    }

    fn by_winding(&mut self, pair: [usize; 2]) -> Option<MergeCertificate> {
        let known = KnownCorridors {
            identities: &self.identities,
            journal: self.journal,
        };
        let ends = pair.map(|visit| self.identities.find(visit));
        let chain = Chain::through(&known, ends, self.config)?;
        let routes = |[from, to]: [usize; 2]| self.constraints.routes(from, to);
        let evidence = WindingEvidence::of(&chain, self.config, self.journal, routes)?;
        let rests_on_looks = !evidence.joins(pair, &self.proven, self.config);
        let proof = MergeProof::Winding(evidence);
        Some(MergeCertificate::sealed(pair, proof, rests_on_looks))
    }

    fn by_looks(&self, pair: [usize; 2], looks: Looks) -> Option<MergeCertificate> {
        let visits = self.alike(pair)?;
        let sealed = |evidence| MergeCertificate::sealed(visits, MergeProof::Looks(evidence), true);
        let mut evidence = LookEvidence::first(visits, looks);
        let mut seen = BTreeSet::from([pair.map(|visit| self.identities.find(visit))]);
        let mut next = 0;
        while let Some(&LookPair {
            visits: [one, other],
            ..
        }) = evidence.pairs.get(next)
        {
            evidence.chance = evidence.stated(self.config, self.journal, |visit| {
                self.identities.find(visit)
            });
            if evidence.chance < self.config.restructuring.look_error {
                return Some(sealed(evidence));
            }
            for (action, to) in self.identities.ways(one) {
                let Some(other) = self.identities.leads(other, action) else {
                    continue;
                };
                if to == other || !seen.insert([to, other]) {
                    continue;
                }
                evidence.pairs.push(LookPair {
                    visits: self.alike([to, other])?,
                    after: Some((next, action)),
                });
            }
            next += 1;
        }
        (evidence.chance < 1.0).then(|| sealed(evidence))
    }

    /// Returns two visits to the places of a pair that look alike.
    fn alike(&self, pair: [usize; 2]) -> Option<[usize; 2]> {
        let [ones, others] = pair.map(|visit| self.views.get(&self.identities.find(visit)));
        let others = others?;
        ones?.iter().find_map(|one| {
            let mut others = others.iter();
            let other =
                others.find(|other| look_alike(*one, **other, self.config, self.journal))?;
            Some([*one, *other])
        })
    }

    /// Takes in the spans that end at a visit.
    fn measure(&mut self, visit: usize) {
        for begin in (visit.saturating_sub(LONGEST)..visit).rev() {
            let span = JournalSpan { begin, end: visit };
            let Some(displacement) = span.displacement(&self.journal.moves, self.config) else {
                break;
            };
            let ends = [begin, visit].map(|end| self.identities.find(end));
            if ends[0] != ends[1] {
                self.constraints.add(ends, span, displacement);
            }
        }
    }

    fn rename(&mut self, joined: Vec<super::identities::Joined>) {
        for one in joined {
            self.constraints.join(one);
            let lost = self.views.remove(&one.lost).unwrap_or_default();
            let mut kept = self.views.remove(&one.kept).unwrap_or_default();
            for view in lost {
                let is_known = kept
                    .iter()
                    .any(|other| look_alike(*other, view, self.config, self.journal));
                if !is_known {
                    kept.push(view);
                }
            }
            self.views.insert(one.kept, kept);
        }
    }
}
