//! Issues and checks certificates: evidence that two nodes of the map are one place.
//!
//! Beyond the paper. A merge rests on one of three grounds, and on the assumptions about the robot
//! and the world in [`Config`]:
//!
//! - *bounds* ([`MergeProof::Bounds`]): routes through the journal bring the two nearer to each
//!   other than two places can be. It is a proof under three conditions. The bounds of odometry
//!   hold, places are δ_sep apart in the sense of [`Apart`](super::Apart), and corridors are as
//!   straight as stated;
//! - *winding* ([`MergeProof::Winding`]): like turns lead from one to the other, along corridors
//!   whose lengths no spiral has. It is a proof if, besides, every place lies δ_sep or more beside
//!   the corridors that do not lead to it, and the robot overlooks no junction;
//! - *looks* ([`MergeProof::Looks`]): the two look alike, and so do the places that the same
//!   actions lead to. It states the probability of being wrong.
//!
//! A proof by bounds may lead through places that are one by looks. It is then no surer than these,
//! and states so ([`MergeCertificate::rests_on_looks`]).
//!
//! In a [static](super::WorldKind::Static) world an action leads from a place to one place and its
//! reverse from there back. What follows from that is known without a route. A move along a way
//! that was taken before has no certificate.
//!
//! [`certify_merges`] goes through a journal and returns a certificate for each merge that the map
//! made. [`verify_merges`] checks certificates against the journal, without the map.

mod constraints;
mod identities;
mod look_evidence;
mod prover;
mod seal;
#[cfg(test)]
#[cfg(feature = "serde")]
mod tampering_tests;
mod verifier;
mod winding_evidence;

use alloc::vec::Vec;
use core::iter;

use tolman_geom::PointBox;

use super::{Action, Config, Looks, MoveOutcome, ObservedMove};
pub use prover::{CertifiedMerges, certify_merges};
pub use verifier::{MergeCertificateError, verify_merges};

use constraints::Constraints;
use identities::Identities;

/// Maximum number of moves of a span.
const LONGEST: usize = 5;

/// A claim that the robot was at one place at two visits, with its evidence.
///
/// Visit 0 is the start. Visit k is at the end of move k of the journal.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MergeCertificate {
    /// The two visits.
    pub visits: [usize; 2],
    /// Ground of the merge: bounds or looks.
    pub proof: MergeProof,
    /// Whether the proof is by looks, or leads through places that an earlier certificate merges by
    /// looks.
    pub rests_on_looks: bool,
    /// Checksum of all fields, which tells a changed certificate from a wrong one.
    pub seal: u64,
}

/// Reason why two visits were to one place.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MergeProof {
    /// Routes from the first visit's place to the second's. The displacement lies in the box of
    /// each route, and the intersection has no room for two places. A route without spans stays at
    /// its place: the two are one by the ways of a static world alone.
    Bounds(Vec<Vec<JournalSpan>>),
    /// Like turns lead round a rectangle.
    Winding(WindingEvidence),
    /// Looks agree along the same actions.
    Looks(LookEvidence),
}

/// A chain of corners with like turns, on which the two visits are four corners apart.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WindingEvidence {
    /// A visit to each corner.
    pub corners: Vec<usize>,
    /// Actions along the first two corridors, which give all others.
    pub begins: [Action; 2],
    /// For each corridor, routes from its first corner to its second, as in
    /// [`MergeProof::Bounds`].
    pub corridors: Vec<Vec<Vec<JournalSpan>>>,
}

/// Successive moves of the journal, as a part of a route.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JournalSpan {
    /// Visit at which the span begins.
    pub begin: usize,
    /// Visit at which the span ends. A span that ends before it begins is followed backward.
    pub end: usize,
}

/// Agreement of the looks.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LookEvidence {
    /// Pairs of visits that look alike; the first pair is at the two places.
    pub pairs: Vec<LookPair>,
    /// The map's counts of how well looks tell places apart. The checker takes these counts as
    /// given if they do not contradict each other.
    pub looks: Looks,
    /// Probability that looks agree as far as these at two different places, 0 … 1.
    pub chance: f64,
}

/// Two visits that look alike, and the action that leads there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LookPair {
    /// Numbers of the two visits.
    pub visits: [usize; 2],
    /// Number of the earlier pair from whose places one action leads to these, with the action.
    /// `None` for the first pair.
    pub after: Option<(usize, Action)>,
}

/// Returns the box of the displacement by all of several routes, m. `None` if a span has no known
/// bounds, or if the routes exclude each other.
fn box_of(
    routes: &[Vec<JournalSpan>],
    moves: &[ObservedMove],
    config: &Config,
) -> Option<PointBox> {
    let along = |route: &Vec<JournalSpan>| {
        let mut spans = route.iter().map(|span| span.displacement(moves, config));
        spans.try_fold(PointBox::ORIGIN, |sum, way| Some(sum + way?))
    };
    let mut boxes = routes.iter().map(along);
    boxes.try_fold(PointBox::UNBOUNDED, |known, one| known.intersection(one?))
}

/// Returns whether each route joins two visits, with only known identities between its spans.
fn connect(
    [one, other]: [usize; 2],
    routes: &[Vec<JournalSpan>],
    identities: &Identities<'_>,
) -> bool {
    routes.iter().all(|route| {
        let here = iter::once(one).chain(route.iter().map(|span| span.end));
        let next = route.iter().map(|span| span.begin).chain([other]);
        here.zip(next)
            .all(|(here, next)| identities.same(here, next))
    })
}

impl JournalSpan {
    const fn reversed(self) -> Self {
        Self {
            begin: self.end,
            end: self.begin,
        }
    }

    /// Returns the box of the displacement between the ends of the span, m. `None` if such moves do
    /// not exist, are too many, or one of them was blocked.
    fn displacement(self, moves: &[ObservedMove], config: &Config) -> Option<PointBox> {
        if self.end < self.begin {
            return Some(-self.reversed().displacement(moves, config)?);
        }
        let gone = moves.get(self.begin..self.end)?;
        let arrived = |step: &ObservedMove| step.outcome == MoveOutcome::Arrived;
        if gone.is_empty() || gone.len() > LONGEST || !gone.iter().all(arrived) {
            return None;
        }
        if let [one] = gone {
            return Some(config.way(one));
        }
        let moved = gone.iter().map(|step| step.odometry.position);
        Some(config.between_places(moved.fold(PointBox::ORIGIN, |sum, one| sum + one)))
    }
}
