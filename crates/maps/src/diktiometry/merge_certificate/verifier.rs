use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::PointBox;

use super::look_evidence::look_alike;
use super::winding_evidence::exits;
use super::{
    Identities, JournalSpan, LookEvidence, MergeCertificate, MergeProof, WindingEvidence, connect,
};
use crate::diktiometry::{Config, Journal, MoveOutcome, Percepts, Similarity};

/// Reason why certificates do not hold. Each names the first that does not, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MergeCertificateError {
    /// The certificate was changed after it was made.
    #[error("certificate {number} was changed, as its seal does not fit; certify the merges again")]
    Changed {
        /// Number of the certificate.
        number: usize,
    },
    /// The journal has no such visit.
    #[error(
        "certificate {number} names visit {visit}, but the journal has only {visits} visits; give the journal it was made from"
    )]
    NoSuchVisit {
        /// Number of the certificate.
        number: usize,
        /// Number of the visit.
        visit: usize,
        /// Number of visits in the journal.
        visits: usize,
    },
    /// A route or a chain of looks has a gap.
    #[error(
        "certificate {number} has a gap, as two visits that it joins are not known to be at one place; certify the merges again"
    )]
    Gap {
        /// Number of the certificate.
        number: usize,
    },
    /// The certificate claims to rest on looks and does not, or the reverse.
    #[error(
        "certificate {number} states wrongly whether it rests on looks; certify the merges again"
    )]
    Ground {
        /// Number of the certificate.
        number: usize,
    },
    /// The certificate's looks prove nothing: there is no pair, or a coincidence is as likely.
    #[error(
        "certificate {number} has looks that fit two places as well as one; collect more looks"
    )]
    NoEvidence {
        /// Number of the certificate.
        number: usize,
    },
    /// The certificate's counts of looks contradict each other.
    #[error(
        "certificate {number} has counts of looks that contradict each other, as a part is more than its whole; certify the merges again"
    )]
    Counts {
        /// Number of the certificate.
        number: usize,
    },
    /// Both looks are at the same place, so that their agreement is no evidence.
    #[error(
        "certificate {number} counts looks at visits {one} and {other}, which are to the same place"
    )]
    OnePlace {
        /// Number of the certificate.
        number: usize,
        /// One visit.
        one: usize,
        /// Number of the second visit.
        other: usize,
    },
    /// A span is invalid: it has no moves, more than five, or a blocked one.
    #[error("certificate {number} has a span from visit {} to {} without known bounds", span.begin, span.end)]
    NoSpan {
        /// Number of the certificate.
        number: usize,
        /// Span without known bounds.
        span: JournalSpan,
    },
    /// The bounds leave room for two places.
    #[error("certificate {number} leaves {most} m between the two, and places are {least} m apart")]
    TooWide {
        /// Number of the certificate.
        number: usize,
        /// Maximum distance between the two, m.
        most: f64,
        /// Minimum distance of two places, m.
        least: f64,
    },
    /// A visit is not to a corner of the chain.
    #[error(
        "certificate {number} takes visit {visit} for one to a corner; certify the merges again"
    )]
    NoCorner {
        /// Number of the certificate.
        number: usize,
        /// Number of the visit.
        visit: usize,
    },
    /// The corridors may be a spiral's.
    #[error("certificate {number} has corridors that may be a spiral's; go round once more")]
    Spiral {
        /// Number of the certificate.
        number: usize,
    },
    /// Two visits do not look alike.
    #[error("certificate {number} says that visits {one} and {other} look alike, but they do not")]
    Unlike {
        /// Number of the certificate.
        number: usize,
        /// One visit.
        one: usize,
        /// Number of the second visit.
        other: usize,
    },
    /// The probability differs from the one computed again.
    #[error("certificate {number} states a probability of {stated}, but it is {found}")]
    Chance {
        /// Number of the certificate.
        number: usize,
        /// Probability stated in the certificate.
        stated: f64,
        /// Probability that the checker found.
        found: f64,
    },
}

/// Checks certificates in order: each may rest on those before it. It reads the journal and the
/// configuration, but no map.
///
/// O(moves + certificates · length of their routes).
///
/// # Errors
/// [`MergeCertificateError`] names the first certificate that does not hold, and why.
pub fn verify_merges(
    config: &Config,
    journal: &Journal,
    certificates: &[MergeCertificate],
) -> Result<(), MergeCertificateError> {
    let mut identities = Identities::new(config);
    for step in &journal.moves {
        match step.outcome {
            MoveOutcome::Blocked => identities.stay(),
            MoveOutcome::Arrived => drop(identities.arrive(step.action)),
        }
    }
    let mut verifier = Verifier {
        config,
        journal,
        proven: identities.clone(),
        identities,
    };
    for (number, certificate) in certificates.iter().enumerate() {
        verifier.take(number, certificate)?;
    }
    Ok(())
}

struct Verifier<'a> {
    config: &'a Config,
    journal: &'a Journal,
    identities: Identities<'a>,
    /// Identities that do not rest on looks.
    proven: Identities<'a>,
}

impl Verifier<'_> {
    fn take(
        &mut self,
        number: usize,
        certificate: &MergeCertificate,
    ) -> Result<(), MergeCertificateError> {
        let [one, other] = certificate.visits;
        if certificate.seal != certificate.checksum() {
            return Err(MergeCertificateError::Changed { number });
        }
        self.known(number, &certificate.visits)?;
        let rests_on_looks = match &certificate.proof {
            MergeProof::Bounds(routes) => {
                let between = self.between(number, certificate.visits, routes)?;
                let least = least_distance(certificate.visits, self.config, self.journal);
                let most = self.config.apart.most(between);
                // A bound that is not a number proves nothing.
                if most.is_nan() || most >= least {
                    return Err(MergeCertificateError::TooWide {
                        number,
                        most,
                        least,
                    });
                }
                !connect(certificate.visits, routes, &self.proven)
            }
            MergeProof::Winding(evidence) => {
                self.winds(number, certificate.visits, evidence)?;
                !evidence.joins(certificate.visits, &self.proven, self.config)
            }
            MergeProof::Looks(evidence) => {
                self.looks(number, certificate.visits, evidence)?;
                true
            }
        };
        if certificate.rests_on_looks != rests_on_looks {
            return Err(MergeCertificateError::Ground { number });
        }
        self.identities.join(one, other);
        if !rests_on_looks {
            self.proven.join(one, other);
        }
        Ok(())
    }

    fn known(&self, number: usize, visits: &[usize]) -> Result<(), MergeCertificateError> {
        let count = self.identities.len();
        match visits.iter().find(|visit| **visit >= count) {
            None => Ok(()),
            Some(&visit) => Err(MergeCertificateError::NoSuchVisit {
                number,
                visit,
                visits: count,
            }),
        }
    }

    /// Returns the bounds on the second visit's place relative to the first's, m, by all routes.
    fn between(
        &self,
        number: usize,
        visits: [usize; 2],
        routes: &[Vec<JournalSpan>],
    ) -> Result<PointBox, MergeCertificateError> {
        for span in routes.iter().flatten() {
            self.known(number, &[span.begin, span.end])?;
        }
        if !connect(visits, routes, &self.identities) {
            return Err(MergeCertificateError::Gap { number });
        }
        let mut between = PointBox::UNBOUNDED;
        for route in routes {
            let mut gone = PointBox::ORIGIN;
            for &span in route {
                let way = span.displacement(&self.journal.moves, self.config);
                let no_span = MergeCertificateError::NoSpan { number, span };
                gone = gone + way.ok_or(no_span)?;
            }
            // Bounds that exclude each other prove nothing.
            let most = f64::INFINITY;
            let none = MergeCertificateError::TooWide {
                number,
                most,
                least: self.config.separation,
            };
            between = between.intersection(gone).ok_or(none)?;
        }
        Ok(between)
    }

    fn winds(
        &self,
        number: usize,
        visits: [usize; 2],
        evidence: &WindingEvidence,
    ) -> Result<(), MergeCertificateError> {
        let named: Vec<usize> = evidence.visits().collect();
        self.known(number, &named)?;
        if let Some(visit) = evidence.no_corner(self.config, self.journal) {
            return Err(MergeCertificateError::NoCorner { number, visit });
        }
        if !evidence.joins(visits, &self.identities, self.config) {
            return Err(MergeCertificateError::Gap { number });
        }
        let corridors = evidence.corners.windows(2).zip(&evidence.corridors);
        let boxes =
            corridors.map(|(ends, routes)| self.between(number, [ends[0], ends[1]], routes));
        let boxes = boxes.collect::<Result<Vec<PointBox>, MergeCertificateError>>()?;
        if !evidence.is_round(&boxes, self.config) {
            return Err(MergeCertificateError::Spiral { number });
        }
        Ok(())
    }

    fn looks(
        &self,
        number: usize,
        visits: [usize; 2],
        evidence: &LookEvidence,
    ) -> Result<(), MergeCertificateError> {
        for (index, pair) in evidence.pairs.iter().enumerate() {
            self.known(number, &pair.visits)?;
            let [one, other] = pair.visits;
            if !look_alike(one, other, self.config, self.journal) {
                return Err(MergeCertificateError::Unlike { number, one, other });
            }
            if self.identities.same(one, other) {
                return Err(MergeCertificateError::OnePlace { number, one, other });
            }
            let expected = match pair.after {
                None if index == 0 => visits.map(Some),
                Some((before, action)) if before < index => {
                    let before = evidence.pairs[before].visits;
                    before.map(|visit| self.identities.leads(visit, action))
                }
                _ => [None; 2],
            };
            let arrives = |(expected, visit): (Option<usize>, usize)| {
                expected.is_some_and(|expected| self.identities.same(expected, visit))
            };
            if !expected.into_iter().zip(pair.visits).all(arrives) {
                return Err(MergeCertificateError::Gap { number });
            }
        }
        if !evidence.looks.is_consistent() {
            return Err(MergeCertificateError::Counts { number });
        }
        let found = evidence.stated(self.config, self.journal, |visit| {
            self.identities.find(visit)
        });
        let stated = evidence.chance;
        if stated.to_bits() != found.to_bits() {
            return Err(MergeCertificateError::Chance {
                number,
                stated,
                found,
            });
        }
        if found >= 1.0 {
            return Err(MergeCertificateError::NoEvidence { number });
        }
        Ok(())
    }
}

/// Returns the minimum distance between the places of two visits, m, as if they were different
/// places.
pub(super) fn least_distance([one, other]: [usize; 2], config: &Config, journal: &Journal) -> f64 {
    let may_be_alike = match config.percepts {
        Percepts::None => true,
        Percepts::Signatures(_) => look_alike(one, other, config, journal),
    };
    let exits = [one, other].map(|visit| exits(visit, journal));
    config.least_distance_of(Similarity::of(may_be_alike), exits)
}

#[cfg(test)]
pub(super) mod tests {
    use alloc::vec;

    use tolman_geom::PoseBox;

    use super::*;
    use crate::diktiometry::merge_certificate::LookPair;
    use crate::diktiometry::{
        Action, Exits, FirstPlace, Looks, ObservedMove, Signature, SignatureKind, ViewRotation,
        WorldKind,
    };

    const EAST: Action = Action(1);
    const WEST: Action = Action(3);

    /// Returns a mapper of places with a colour to each side, in a world that stays as it is.
    pub(in super::super) fn config() -> Config {
        let mut config = Config::new(Config::compass_actions(), 1.0);
        config.world = WorldKind::Static;
        config.percepts = Percepts::Signatures(SignatureKind {
            rows: 1,
            columns: 4,
            tolerance: 0.4,
            share: 1.0,
            rotation: ViewRotation::Aligned,
            views: 2,
        });
        config
    }

    /// Returns a robot that goes along `actions` past places that all look alike.
    fn journal(actions: &[Action]) -> Journal {
        let percept = Some(Signature::new(1, vec![0.5; 4]).unwrap());
        let moves = actions.iter().map(|&action| ObservedMove {
            action,
            odometry: PoseBox::IDENTITY,
            percept: percept.clone(),
            exits: Exits::Unknown,
            outcome: MoveOutcome::Arrived,
        });
        Journal {
            moves: moves.collect(),
            start: FirstPlace {
                percept: percept.clone(),
                exits: Exits::Unknown,
            },
            distinctions: Vec::new(),
        }
    }

    fn by_looks(pairs: &[[usize; 2]], looks: Looks, journal: &Journal) -> MergeCertificate {
        let mut evidence = LookEvidence {
            pairs: Vec::new(),
            looks,
            chance: 1.0,
        };
        evidence.pairs.extend(pairs.iter().map(|&visits| LookPair {
            visits,
            after: None,
        }));
        evidence.chance = evidence.stated(&config(), journal, |visit| visit);
        MergeCertificate::sealed([0, 2], MergeProof::Looks(evidence), true)
    }

    fn telling() -> Looks {
        Looks {
            kinds: 100,
            different: 4000,
            ..Looks::default()
        }
    }

    #[test]
    fn looks_that_say_nothing_are_refused() {
        let ahead = journal(&[EAST, EAST]);
        let verify = |certificate| verify_merges(&config(), &ahead, &[certificate]);
        assert_eq!(verify(by_looks(&[[0, 2]], telling(), &ahead)), Ok(()));
        let refused = Err(MergeCertificateError::NoEvidence { number: 0 });
        assert_eq!(verify(by_looks(&[], telling(), &ahead)), refused);
        let unknown = Looks::default();
        assert_eq!(verify(by_looks(&[[0, 2]], unknown, &ahead)), refused);
    }

    #[test]
    fn looks_at_one_place_are_refused() {
        let there_and_back = journal(&[EAST, WEST]);
        let found = verify_merges(
            &config(),
            &there_and_back,
            &[by_looks(&[[0, 2]], telling(), &there_and_back)],
        );
        let (number, one, other) = (0, 0, 2);
        let refused = MergeCertificateError::OnePlace { number, one, other };
        assert_eq!(found, Err(refused));
    }

    #[test]
    fn a_proof_by_bounds_through_looks_says_so() {
        let ahead = journal(&[EAST, EAST, EAST]);
        let first = by_looks(&[[0, 2]], telling(), &ahead);
        // What is east of one place is one place.
        let verify = |rests_on_looks| {
            let second =
                MergeCertificate::sealed([1, 3], MergeProof::Bounds(vec![vec![]]), rests_on_looks);
            verify_merges(&config(), &ahead, &[first.clone(), second])
        };
        assert_eq!(verify(true), Ok(()));
        assert_eq!(
            verify(false),
            Err(MergeCertificateError::Ground { number: 1 })
        );
    }
}
