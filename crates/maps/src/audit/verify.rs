//! Verifies audits: measures every cycle again from the graph alone.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use thiserror::Error;

use super::auditor::check;
use super::chain::Chain;
use super::cycle::Board;
use super::link::links;
use super::{
    Audit, AuditConfig, AuditCycle, AuditError, AuditedClosure, ClosureVerdict, CycleError,
    RefutedBy,
};
use crate::pose_graph::{PoseEdgeKind, PoseGraph};

/// Maximum relative difference between a number of a certificate and its new measurement.
const ROUNDING: f64 = 1e-7;

/// Reason why a certificate does not hold.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AuditCertificateError {
    /// The graph itself cannot be audited.
    #[error(transparent)]
    Graph(#[from] AuditError),
    /// The certificate's edge is not a closure of this graph.
    #[error("edge {edge} is not a closure of this graph; name the graph that was audited")]
    NoClosure {
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// A closure has two certificates.
    #[error("edge {edge} has two certificates; remove one")]
    Twice {
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// A cycle is invalid.
    #[error("the cycle of edge {edge} is invalid: {error}; audit the graph again")]
    Cycle {
        /// Number of the edge, from 0.
        edge: u32,
        /// The underlying error.
        error: CycleError,
    },
    /// A cycle begins with another closure than its certificate's.
    #[error("a cycle of edge {edge} begins with another edge; audit the graph again")]
    Another {
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// A residual, covariance or χ² differs from what the graph gives.
    #[error(
        "{what} of a cycle of edge {edge} is stated as {told}, but the graph gives {measured}; audit the graph again"
    )]
    Number {
        /// Number of the edge, from 0.
        edge: u32,
        /// Name of the number.
        what: &'static str,
        /// The certificate's value.
        told: f64,
        /// The measured value.
        measured: f64,
    },
    /// The cycle that should refute a closure is within its bound.
    #[error(
        "the cycle of edge {edge} refutes nothing, as its χ² {chi2} is within the bound {most}; audit the graph again"
    )]
    Within {
        /// Number of the edge, from 0.
        edge: u32,
        /// χ² of the cycle.
        chi2: f64,
        /// Maximum χ², which is k².
        most: f64,
    },
    /// A cycle that should support a closure is beyond its bound or too wide.
    #[error(
        "a cycle of edge {edge} does not support it: its χ² is {chi2} of at most {most}, or its region is too wide; audit the graph again"
    )]
    Unsupported {
        /// Number of the edge, from 0.
        edge: u32,
        /// χ² of the cycle.
        chi2: f64,
        /// Maximum χ², which is k².
        most: f64,
    },
    /// A closure has no cycle that supports it.
    #[error("the audit calls edge {edge} supported, but gives no cycle; audit the graph again")]
    NoWitness {
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// A cycle leads over a closure without a certificate of its own.
    #[error(
        "a cycle of edge {edge} leads over edge {over}, which no certificate supports; audit the graph again"
    )]
    Unproven {
        /// Number of the edge, from 0.
        edge: u32,
        /// The closure over which the cycle leads.
        over: u32,
    },
    /// A cycle leads over a closure of a run that already counts.
    #[error(
        "a cycle of edge {edge} leads over edge {over}, whose run is a witness already; audit the graph again"
    )]
    SameRun {
        /// Number of the edge, from 0.
        edge: u32,
        /// The closure over which the cycle leads.
        over: u32,
    },
    /// The cycle that refutes a closure has other steps than the audit states.
    #[error(
        "the cycle of edge {edge} has other steps than the audit states; audit the graph again"
    )]
    RefutedBy {
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// The number of runs differs.
    #[error(
        "the audit states {told} runs of closures, but the graph gives {measured}; audit the graph again"
    )]
    Runs {
        /// The audit's value.
        told: u32,
        /// The graph's value.
        measured: u32,
    },
    /// A closure belongs to another run than the audit states.
    #[error(
        "the audit puts edge {edge} into run {told}, but the graph gives {measured}; audit the graph again"
    )]
    Run {
        /// Number of the edge, from 0.
        edge: u32,
        /// The certificate's value.
        told: u32,
        /// The graph's value.
        measured: u32,
    },
}

impl AuditCertificateError {
    /// Returns the edge of the certificate at fault; `None` if the graph itself is.
    #[must_use]
    pub const fn edge(&self) -> Option<u32> {
        match self {
            Self::Graph(_) | Self::Runs { .. } => None,
            Self::NoClosure { edge }
            | Self::Twice { edge }
            | Self::Cycle { edge, .. }
            | Self::Another { edge }
            | Self::Number { edge, .. }
            | Self::Within { edge, .. }
            | Self::Unsupported { edge, .. }
            | Self::NoWitness { edge }
            | Self::Unproven { edge, .. }
            | Self::SameRun { edge, .. }
            | Self::RefutedBy { edge }
            | Self::Run { edge, .. } => Some(*edge),
        }
    }
}

/// Checks every cycle of an audit again, from the graph alone. It checks that:
///
/// - it is a cycle, with the stated numbers and on the stated side of its bound;
/// - it leads over odometry and supported closures only;
/// - these closures are of runs that are not counted yet.
///
/// It cannot check that no other cycle agrees with a refuted closure. Undecided closures are
/// skipped.
///
/// # Errors
/// [`AuditCertificateError`] of the first certificate that does not hold.
///
/// # Complexity
/// O(edges of all cycles + closures · log closures).
pub fn verify(
    graph: &PoseGraph,
    config: &AuditConfig,
    audit: &Audit,
) -> Result<(), AuditCertificateError> {
    check(config)?;
    let chain = Chain::of(graph, config)?;
    let runs = links(graph, &chain, config);
    let runs: BTreeMap<u32, u32> = runs.iter().map(|link| (link.edge, link.run)).collect();
    let measured = runs.values().max().map_or(0, |last| last + 1);
    if audit.runs != measured {
        return Err(AuditCertificateError::Runs {
            told: audit.runs,
            measured,
        });
    }
    let supported = audit
        .closures
        .iter()
        .filter(|closure| closure.verdict.is_supported());
    let checker = Checker {
        board: Board::new(graph, &chain, config),
        config,
        runs,
        supported: supported.map(|closure| closure.edge).collect(),
    };
    let mut seen = BTreeSet::new();
    for closure in &audit.closures {
        if !seen.insert(closure.edge) {
            return Err(AuditCertificateError::Twice { edge: closure.edge });
        }
        checker.check(closure)?;
    }
    Ok(())
}

struct Checker<'a> {
    board: Board<'a>,
    config: &'a AuditConfig,
    runs: BTreeMap<u32, u32>,
    supported: BTreeSet<u32>,
}

impl Checker<'_> {
    fn check(&self, closure: &AuditedClosure) -> Result<(), AuditCertificateError> {
        let edge = closure.edge;
        let edges = self.board.graph.edges();
        let is_closure =
            edges.get(edge as usize).map(|edge| edge.kind) == Some(PoseEdgeKind::Closure);
        let Some(run) = self.runs.get(&edge).filter(|_| is_closure) else {
            return Err(AuditCertificateError::NoClosure { edge });
        };
        if *run != closure.run {
            return Err(AuditCertificateError::Run {
                edge,
                told: closure.run,
                measured: *run,
            });
        }
        let mut counted = alloc::vec![*run];
        match &closure.verdict {
            ClosureVerdict::Refuted { by, cycle } => {
                self.check_refuted(edge, *by, cycle, &mut counted)
            }
            ClosureVerdict::Supported { witnesses } => {
                self.check_supported(edge, witnesses, &mut counted)
            }
            ClosureVerdict::Undecided(_) => Ok(()),
        }
    }

    fn check_refuted(
        &self,
        edge: u32,
        by: RefutedBy,
        cycle: &AuditCycle,
        counted: &mut Vec<u32>,
    ) -> Result<(), AuditCertificateError> {
        let measured = self.measure(edge, cycle, counted)?;
        let most = self.config.most_chi2();
        if !measured.gap().refutes(self.config) {
            return Err(AuditCertificateError::Within {
                edge,
                chi2: measured.chi2,
                most,
            });
        }
        let alone = measured.closures().next().is_none();
        match (by == RefutedBy::Odometry) == alone {
            true => Ok(()),
            false => Err(AuditCertificateError::RefutedBy { edge }),
        }
    }

    fn check_supported(
        &self,
        edge: u32,
        witnesses: &[AuditCycle],
        counted: &mut Vec<u32>,
    ) -> Result<(), AuditCertificateError> {
        if witnesses.is_empty() {
            return Err(AuditCertificateError::NoWitness { edge });
        }
        let mut alone = 0;
        for witness in witnesses {
            let measured = self.measure(edge, witness, counted)?;
            alone += u32::from(measured.closures().next().is_none());
            if !measured.gap().supports(self.config) || alone > 1 {
                let most = self.config.most_chi2();
                return Err(AuditCertificateError::Unsupported {
                    edge,
                    chi2: measured.chi2,
                    most,
                });
            }
        }
        Ok(())
    }

    /// Measures a cycle again, compares its numbers with the certificate's, and counts its runs.
    fn measure(
        &self,
        edge: u32,
        cycle: &AuditCycle,
        counted: &mut Vec<u32>,
    ) -> Result<AuditCycle, AuditCertificateError> {
        if cycle.steps.first().and_then(|step| step.over) != Some(edge) {
            return Err(AuditCertificateError::Another { edge });
        }
        let measured = AuditCycle::measured(cycle.steps.clone(), &self.board);
        let measured = measured.map_err(|error| AuditCertificateError::Cycle { edge, error })?;
        compare(edge, cycle, &measured)?;
        let mut new = Vec::new();
        for over in measured.closures() {
            if !self.supported.contains(&over) {
                return Err(AuditCertificateError::Unproven { edge, over });
            }
            let run = self.runs.get(&over).copied();
            match run.filter(|run| !counted.contains(run)) {
                Some(run) => new.push(run),
                None => return Err(AuditCertificateError::SameRun { edge, over }),
            }
        }
        counted.append(&mut new);
        Ok(measured)
    }
}

/// Compares the numbers of a certificate with the measured ones.
fn compare(
    edge: u32,
    told: &AuditCycle,
    measured: &AuditCycle,
) -> Result<(), AuditCertificateError> {
    let largest = |numbers: &[f64]| {
        numbers
            .iter()
            .fold(0.0_f64, |most, number| most.max(number.abs()))
    };
    for (what, told, measured) in [
        ("the residual", &told.residual[..], &measured.residual[..]),
        (
            "the covariance",
            &told.covariance[..],
            &measured.covariance[..],
        ),
        ("χ²", &[told.chi2][..], &[measured.chi2][..]),
    ] {
        let allowed = ROUNDING * largest(measured);
        for (told, measured) in told.iter().zip(measured) {
            // NaN does not agree, either.
            let agrees = (told - measured).abs() <= allowed;
            if !agrees {
                let (told, measured) = (*told, *measured);
                return Err(AuditCertificateError::Number {
                    edge,
                    what,
                    told,
                    measured,
                });
            }
        }
    }
    Ok(())
}
