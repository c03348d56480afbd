//! Audits a graph: from its odometry and closures to the verdicts.

use alloc::vec::Vec;

use tolman_geom::Pose;

use super::belief::Belief;
use super::chain::Chain;
use super::consistency::{ByOdometry, Pairs};
use super::cycle::Board;
use super::link::{Gap, Link, links};
use super::motion::Spread;
use super::way::Way;
use super::{
    Audit, AuditConfig, AuditCycle, AuditError, AuditedClosure, ClosureVerdict, RefutedBy,
    UndecidedBecause,
};
use crate::pose_graph::PoseGraph;

/// Audits the closures of a graph and returns the verdict on each: supported, refuted or undecided,
/// by the odometry and the other closures. The poses' positions do not matter. Poses are numbered
/// in the order they were driven.
///
/// # Errors
/// [`AuditError`] if odometry does not join a pose with the next, or the scale of the standard
/// deviations is not a positive number.
///
/// # Complexity
/// O(pairs + closures · (edges · log edges)), where pairs are those of closures that begin and end
/// within [`pair_gap`](AuditConfig::pair_gap) poses; a closure that odometry refutes costs O(1).
///
/// ```
/// use tolman_maps::audit::{AuditConfig, audit};
/// use tolman_maps::geom::nalgebra::{Matrix3, Vector3};
/// use tolman_maps::geom::{Heading, Point, Pose};
/// use tolman_maps::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};
///
/// // Two rounds of a square of 10 m; the second time every corner is seen again, and one is taken for the next.
/// let information = Matrix3::from_diagonal(&Vector3::new(2500.0, 2500.0, 10000.0));
/// let side = Pose::new(Point::new(10.0, 0.0), Heading::NORTH);
/// let mut graph = PoseGraph::new();
/// for _ in 0..12 {
///     graph.add_pose(Pose::IDENTITY);
/// }
/// for to in 1..12 {
///     let kind = PoseEdgeKind::Odometry;
///     graph.add_edge(PoseEdge { from: to - 1, to, measured: side, information, kind })?;
/// }
/// for (from, to) in [(0, 4), (4, 8), (1, 8)] {
///     let (measured, kind) = (Pose::IDENTITY, PoseEdgeKind::Closure);
///     graph.add_edge(PoseEdge { from, to, measured, information, kind })?;
/// }
/// let audit = audit(&graph, &AuditConfig::standard())?;
/// assert!(audit.closures[0].verdict.is_supported());
/// assert!(audit.closures[2].verdict.is_refuted());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub fn audit(graph: &PoseGraph, config: &AuditConfig) -> Result<Audit, AuditError> {
    check(config)?;
    let chain = Chain::of(graph, config)?;
    let links = links(graph, &chain, config);
    let by_odometry: Vec<ByOdometry> = links
        .iter()
        .map(|link| ByOdometry::of(link, &chain, config))
        .collect();
    let pairs = Pairs::of(&links, &by_odometry, &chain, config);
    let mut belief = Belief::new(&links, &chain, config, &by_odometry);
    belief.settle(&pairs);
    let board = Board::new(graph, &chain, config);
    let mut judge = Judge {
        belief,
        pairs: &pairs,
        board: &board,
    };
    let mut closures: Vec<AuditedClosure> = (0..links.len() as u32)
        .filter_map(|link| judge.closure(link))
        .collect();
    closures.sort_by_key(|closure| closure.edge);
    let runs = links.iter().map(|link| link.run + 1).max().unwrap_or(0);
    Ok(Audit { closures, runs })
}

pub(super) fn check(config: &AuditConfig) -> Result<(), AuditError> {
    let scale = config.sigma_scale;
    match scale > 0.0 && scale.is_finite() {
        true => Ok(()),
        false => Err(AuditError::Scale { scale }),
    }
}

/// Returns the error (χ²) of the refuting cycle for each refuted closure, by edge. The closure
/// itself is replaced by the truth, so this is the error of its witnesses. `poses` are the true
/// ones. A certificate above the bound is not reliable.
///
/// # Errors
/// As [`audit`].
pub fn errors_of_witnesses(
    graph: &PoseGraph,
    config: &AuditConfig,
    audit: &Audit,
    poses: &[Pose],
) -> Result<Vec<(u32, f64)>, AuditError> {
    check(config)?;
    let chain = Chain::of(graph, config)?;
    let board = Board::new(graph, &chain, config);
    let refuted = audit.closures.iter().filter_map(|closure| {
        let ClosureVerdict::Refuted { cycle, .. } = &closure.verdict else {
            return None;
        };
        let first = cycle.steps.first()?;
        let from = poses.get(first.from as usize)?;
        let truth = from.between(*poses.get(first.to as usize)?);
        let chi2 = cycle.chi2_of_witnesses(&board, truth).ok()?;
        Some((closure.edge, chi2))
    });
    Ok(refuted.collect())
}

/// Gives the verdict on each closure, once the set of believed closures is settled.
struct Judge<'a, 'b> {
    belief: Belief<'a>,
    pairs: &'b Pairs,
    board: &'b Board<'b>,
}

impl Judge<'_, '_> {
    fn link(&self, link: u32) -> &Link {
        &self.belief.links[link as usize]
    }

    fn closure(&mut self, link: u32) -> Option<AuditedClosure> {
        let verdict = self.verdict(link)?;
        Some(AuditedClosure {
            edge: self.link(link).edge,
            run: self.link(link).run,
            verdict,
        })
    }

    fn verdict(&mut self, link: u32) -> Option<ClosureVerdict> {
        if self.belief.by_odometry[link as usize] == ByOdometry::Refutes {
            let cycle = self.cycle(link, &Way::of_odometry(self.link(link)))?;
            let by = RefutedBy::Odometry;
            return Some(ClosureVerdict::Refuted { by, cycle });
        }
        let Some((way, gap)) = self.belief.found[link as usize].take() else {
            return Some(ClosureVerdict::Undecided(UndecidedBecause::Wide {
                position: f64::INFINITY,
                heading: core::f64::consts::PI,
            }));
        };
        let config = self.belief.config;
        if gap.supports(config) {
            return Some(ClosureVerdict::Supported {
                witnesses: self.witnesses(link, &way)?,
            });
        }
        let by_odometry = way.closures().next().is_none();
        let doubt = match by_odometry {
            true => {
                (self.belief.chain).doubt(self.link(link).first, self.link(link).second, config)
            }
            false => 1.0,
        };
        if gap.refutes_over(doubt, config) {
            return self.against(link, &way);
        }
        Some(ClosureVerdict::Undecided(self.undecided(link, &gap)))
    }

    fn cycle(&self, link: u32, way: &Way) -> Option<AuditCycle> {
        // Ways lead along what is there.
        AuditCycle::of(self.link(link), way, self.belief.links, self.board).ok()
    }

    /// Returns the cycles that agree with a closure and share no run. The surest comes first, then
    /// those over one other closure, then odometry alone.
    fn witnesses(&self, link: u32, way: &Way) -> Option<Vec<AuditCycle>> {
        let links = self.belief.links;
        let mut runs: Vec<u32> = alloc::vec![self.link(link).run];
        runs.extend(way.closures().map(|over| links[over as usize].run));
        let mut witnesses = alloc::vec![self.cycle(link, way)?];
        let most = self.belief.config.most_witnesses;
        for over in &self.pairs.agreeing[link as usize] {
            let run = links[*over as usize].run;
            if witnesses.len() >= most {
                break;
            }
            if self.belief.believed[*over as usize] && !runs.contains(&run) {
                let way = Way::over(self.link(link), *over, links);
                witnesses.extend(self.witness(link, &way));
                runs.push(run);
            }
        }
        let is_needed = witnesses.len() < most && way.closures().next().is_some();
        if is_needed && self.belief.by_odometry[link as usize] == ByOdometry::Supports {
            witnesses.extend(self.witness(link, &Way::of_odometry(self.link(link))));
        }
        Some(witnesses)
    }

    fn witness(&self, link: u32, way: &Way) -> Option<AuditCycle> {
        let cycle = self.cycle(link, way)?;
        cycle.gap().supports(self.belief.config).then_some(cycle)
    }

    /// Returns the verdict on a closure whose cycle is beyond its bound.
    fn against(&mut self, link: u32, way: &Way) -> Option<ClosureVerdict> {
        let against = self.cycle(link, way)?;
        let shunned: Vec<u32> = way.closures().collect();
        if let Some(agreeing) = self.second_opinion(link, &shunned) {
            let because = UndecidedBecause::Contradictory { against, agreeing };
            return Some(ClosureVerdict::Undecided(because));
        }
        Some(ClosureVerdict::Refuted {
            by: match shunned.is_empty() {
                true => RefutedBy::Odometry,
                false => RefutedBy::SupportedClosures,
            },
            cycle: against,
        })
    }

    /// Returns the surest cycle that shares no run with `shunned`, if it agrees and is not much
    /// wider than tight.
    fn second_opinion(&mut self, link: u32, shunned: &[u32]) -> Option<AuditCycle> {
        let Belief {
            links,
            chain,
            config,
            ..
        } = self.belief;
        let believed = &self.belief.believed;
        let way = self.belief.search.way(link, links, believed, shunned)?;
        let gap = way.gap(&links[link as usize], links, chain);
        // Ten times the region of a tight one.
        let agrees = gap.agrees(config) && gap.spread.det() <= 100.0 * config.most_det();
        agrees.then(|| self.cycle(link, &way)).flatten()
    }

    fn undecided(&self, link: u32, gap: &Gap) -> UndecidedBecause {
        let run = self.link(link).run;
        let of_run = self.belief.links.iter().filter(|other| other.run == run);
        let closures = of_run.clone().count() as u32;
        let own = self.link(link);
        let agrees = |other: &Link| {
            let gap = own.gap_to(other, self.belief.chain);
            gap.is_some_and(|gap| gap.supports(self.belief.config))
        };
        if of_run.filter(|other| other.edge != own.edge).any(agrees) {
            return UndecidedBecause::SingleRun { closures };
        }
        let bound = self.belief.config.bound;
        let heading = bound * libm::sqrt(gap.spread.tt);
        UndecidedBecause::Wide {
            position: bound * self.at_second(own, gap).widest(),
            heading: heading.min(core::f64::consts::PI),
        }
    }

    /// Returns the covariance at a pose by odometry, as seen from the higher pose.
    fn at_second(&self, link: &Link, gap: &Gap) -> Spread {
        let second = &self.belief.chain.reckoned[link.second as usize];
        gap.spread.seen_from(&second.inverse())
    }
}
