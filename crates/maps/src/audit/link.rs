//! Prepares the closures for comparison.

use alloc::vec::Vec;

use super::AuditConfig;
use super::chain::{Chain, cost_of, forward};
use super::motion::{Motion, Spread};
use super::run::{Ends, runs};
use crate::pose_graph::{PoseEdgeKind, PoseGraph};

/// A closure, measured from its lower pose to its higher.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) edge: u32,
    pub(super) first: u32,
    pub(super) second: u32,
    /// Disagreement with odometry, seen from the piece of the first pose; the identity if it
    /// agrees.
    pub(super) off: Motion,
    pub(super) off_inverse: Motion,
    /// Covariance of the closure's measurement, seen from the first pose of the second pose's
    /// piece.
    pub(super) spread: Spread,
    pub(super) cost: f64,
    pub(super) run: u32,
}

/// Residual of a cycle: its χ² and its spread.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub(super) chi2: f64,
    pub(super) spread: Spread,
}

impl Gap {
    pub(super) fn of(off: &Motion, spread: &Spread) -> Self {
        Self {
            chi2: spread.chi2(&off.log()),
            spread: *spread,
        }
    }

    /// Returns whether the gap is within its bound.
    pub(super) fn agrees(&self, config: &AuditConfig) -> bool {
        self.chi2 <= config.most_chi2()
    }

    /// Returns whether the gap is beyond its bound, and by more than rounding.
    pub(super) fn refutes(&self, config: &AuditConfig) -> bool {
        self.refutes_over(1.0, config)
    }

    /// Returns whether the gap is beyond `doubt` times its bound, and by more than rounding.
    pub(super) fn refutes_over(&self, doubt: f64, config: &AuditConfig) -> bool {
        self.chi2 > doubt * config.most_chi2() * (1.0 + 1e-6)
    }

    /// Returns whether the gap's region of uncertainty excludes most nearby poses.
    pub(super) fn is_tight(&self, config: &AuditConfig) -> bool {
        self.spread.det() <= config.most_det()
    }

    pub(super) fn supports(&self, config: &AuditConfig) -> bool {
        self.agrees(config) && self.is_tight(config)
    }
}

/// Returns the closures in the order of their poses, with their runs. O(closures · log closures)
/// for closures that are spread out.
pub(super) fn links(graph: &PoseGraph, chain: &Chain, config: &AuditConfig) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for (index, edge) in (0..).zip(graph.edges()) {
        if edge.kind == PoseEdgeKind::Closure {
            let (first, second) = (edge.from.min(edge.to), edge.from.max(edge.to));
            let (measured, spread) = forward(edge, config);
            let [start, end] = [first, second].map(|pose| chain.reckoned[pose as usize]);
            let off = start.then(&Motion::from(measured)).then(&end.inverse());
            links.push(Link {
                edge: index,
                first,
                second,
                off_inverse: off.inverse(),
                off,
                cost: cost_of(&spread, config),
                spread: spread.seen_from(&end),
                run: 0,
            });
        }
    }
    links.sort_by_key(|link| (link.first, link.second, link.edge));
    let ends = links.iter().map(|link| Ends {
        poses: [link.first, link.second],
        driven: [link.first, link.second].map(|pose| chain.driven[pose as usize]),
    });
    let ends: Vec<Ends> = ends.collect();
    let agree = |a: usize, b: usize| {
        let gap = links[a].gap_to(&links[b], chain);
        gap.is_none_or(|gap| !gap.refutes(config))
    };
    let runs = runs(&ends, config.run_gap, config.run_way, agree);
    for (link, run) in links.iter_mut().zip(runs) {
        link.run = run;
    }
    links
}

impl Link {
    /// Returns the closure's gap from odometry alone; `None` if odometry does not join the
    /// closure's poses. O(1).
    pub(super) fn gap_to_odometry(&self, chain: &Chain) -> Option<Gap> {
        let joined = chain.joins(self.first, self.second);
        joined.then(|| {
            let spread = chain.span(self.first, self.second).plus(&self.spread);
            Gap::of(&self.off, &spread)
        })
    }

    /// Returns the gap of the cycle over both closures and the odometry between their ends; `None`
    /// if odometry does not join these. O(1).
    pub(super) fn gap_to(&self, other: &Self, chain: &Chain) -> Option<Gap> {
        let joined = chain.joins(self.first, other.first) && chain.joins(self.second, other.second);
        joined.then(|| {
            let near_first = chain.span(self.first, other.first);
            let spread = near_first
                .seen_from(&self.off_inverse)
                .plus(&chain.span(self.second, other.second))
                .plus(&self.spread)
                .plus(&other.spread);
            Gap::of(&self.off_inverse.then(&other.off), &spread)
        })
    }
}
