use alloc::vec::Vec;

use super::AuditCycle;

/// Result of auditing the closures of a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Audit {
    /// Result for each closure, in the order of the graph's edges.
    pub closures: Vec<AuditedClosure>,
    /// Number of runs that the closures form: the maximum number of witnesses.
    pub runs: u32,
}

/// Result for one closure.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditedClosure {
    /// Number of the closure's edge in the graph.
    pub edge: u32,
    /// Number of the closure's run, from 0. Closures of one run err together.
    pub run: u32,
    /// Verdict on the closure.
    pub verdict: ClosureVerdict,
}

/// Whether a closure is right, as far as odometry and the other closures tell.
#[derive(Clone, Debug, PartialEq)]
pub enum ClosureVerdict {
    /// Tight cycles within their bounds agree with the closure, and share no run with it or each
    /// other. This is evidence, not proof.
    Supported {
        /// Cycles that agree, the surest first; at most
        /// [`AuditConfig::most_witnesses`](super::AuditConfig::most_witnesses).
        witnesses: Vec<AuditCycle>,
    },
    /// A cycle is beyond its bound, and none was found that agrees and shares no run with it.
    Refuted {
        /// Contents of the cycle beside the closure.
        by: RefutedBy,
        /// Cycle beyond its bound.
        cycle: AuditCycle,
    },
    /// Neither.
    Undecided(UndecidedBecause),
}

/// Evidence that refutes a closure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RefutedBy {
    /// Odometry alone. The closure is wrong if the odometry's bounds hold, whatever the other
    /// closures are.
    Odometry,
    /// Odometry and supported closures. The closure is wrong if their bounds hold and they are
    /// right.
    SupportedClosures,
}

/// Reason why a closure is undecided.
#[derive(Clone, Debug, PartialEq)]
pub enum UndecidedBecause {
    /// The way between its poses is too uncertain to tell.
    Wide {
        /// Greatest half-axis of the region in which the pose may lie, m; infinite if nothing leads
        /// there.
        position: f64,
        /// Half-width of the headings that the pose may have, rad.
        heading: f64,
    },
    /// Only closures of its own run agree with it, and a run is one witness.
    SingleRun {
        /// Number of closures in the run.
        closures: u32,
    },
    /// A cycle is beyond its bound, and another one that shares no run with it agrees.
    Contradictory {
        /// The cycle beyond its bound.
        against: AuditCycle,
        /// The cycle that agrees.
        agreeing: AuditCycle,
    },
}

impl ClosureVerdict {
    /// Returns whether the closure is supported.
    #[must_use]
    pub const fn is_supported(&self) -> bool {
        matches!(self, Self::Supported { .. })
    }

    /// Returns whether the closure is refuted.
    #[must_use]
    pub const fn is_refuted(&self) -> bool {
        matches!(self, Self::Refuted { .. })
    }
}

impl Audit {
    /// Returns the number of closures whose verdict satisfies `is`.
    #[must_use]
    pub fn count(&self, is: impl Fn(&ClosureVerdict) -> bool) -> usize {
        let verdicts = self.closures.iter().map(|closure| &closure.verdict);
        verdicts.filter(|verdict| is(verdict)).count()
    }
}
