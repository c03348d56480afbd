//! Measures cycles edge by edge: the contents of a certificate.

use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::Pose;

use super::AuditConfig;
use super::chain::{Chain, spread_of};
use super::link::{Gap, Link};
use super::motion::{Motion, Spread};
use super::way::{Leg, Way};
use crate::pose_graph::{PoseEdgeKind, PoseGraph};

/// A cycle that begins with the closure in question, and its error.
///
/// Its product is that of the measurements along it, each inverted where it is walked against its
/// direction. For exact measurements it is the identity.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AuditCycle {
    /// Parts of the cycle. Each begins where the one before ends, and the last ends where the first
    /// begins.
    pub steps: Vec<CycleStep>,
    /// The logarithm of the product: x, y, m, heading, rad.
    pub residual: [f64; 3],
    /// The covariance of the residual by first-order propagation, its upper triangle row by row.
    pub covariance: [f64; 6],
    /// The squared Mahalanobis distance of the residual from zero, χ² with 3 degrees of freedom.
    pub chi2: f64,
}

/// A part of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CycleStep {
    /// Pose that the step leaves.
    pub from: u32,
    /// Pose to which the step leads.
    pub to: u32,
    /// Edge of the closure that the step leads over. `None` if it leads along the odometry, from
    /// pose to pose.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub over: Option<u32>,
}

/// Reason why some steps do not form a cycle of a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CycleError {
    /// There are no steps, or the first is not a closure.
    #[error("it does not begin with its closure")]
    Beginning,
    /// A step does not begin where the one before ends, or the last does not end where the first
    /// begins.
    #[error("step {step} begins at pose {from}, but the step before ends at {to}")]
    Gap {
        /// Number of the step, from 0.
        step: usize,
        /// Pose at which the step begins.
        from: u32,
        /// Pose at which the step before ends.
        to: u32,
    },
    /// A step leads over an edge that is not a closure between its poses.
    #[error("step {step} leads over edge {edge}, which is not a closure between its poses")]
    NoClosure {
        /// Number of the step, from 0.
        step: usize,
        /// Number of the edge, from 0.
        edge: u32,
    },
    /// A step leads along odometry that does not exist.
    #[error("step {step} needs odometry to pose {pose}, which does not exist")]
    NoOdometry {
        /// Number of the step, from 0.
        step: usize,
        /// Number of the pose.
        pose: u32,
    },
    /// A step leads nowhere.
    #[error("step {step} leads from a pose to itself")]
    Nowhere {
        /// Number of the step, from 0.
        step: usize,
    },
}

impl AuditCycle {
    /// Measures the cycle that leads over a closure and back along a way.
    pub(super) fn of(
        link: &Link,
        way: &Way,
        links: &[Link],
        board: &Board<'_>,
    ) -> Result<Self, CycleError> {
        let step = |from, to, over: Option<u32>| CycleStep {
            from,
            to,
            over: over.map(|over| links[over as usize].edge),
        };
        let forth: Vec<CycleStep> = way
            .legs
            .iter()
            .map(|leg| match *leg {
                Leg::Span(from, to) => step(from, to, None),
                Leg::Up(over) => step(
                    links[over as usize].first,
                    links[over as usize].second,
                    Some(over),
                ),
                Leg::Down(over) => step(
                    links[over as usize].second,
                    links[over as usize].first,
                    Some(over),
                ),
            })
            .collect();
        // From its lower pose to its higher, as the way was measured, whichever way the edge itself
        // leads.
        let mut steps = alloc::vec![step(link.first, link.second, None)];
        steps[0].over = Some(link.edge);
        let back = forth.into_iter().rev();
        steps.extend(back.map(|step| CycleStep {
            from: step.to,
            to: step.from,
            over: step.over,
        }));
        Self::measured(steps, board)
    }

    /// Measures the cycle of some steps, edge by edge. O(edges of the cycle).
    pub(super) fn measured(steps: Vec<CycleStep>, board: &Board<'_>) -> Result<Self, CycleError> {
        let mut walk = Walk::begin();
        let (Some(first), Some(last)) = (steps.first(), steps.last()) else {
            return Err(CycleError::Beginning);
        };
        if first.over.is_none() {
            return Err(CycleError::Beginning);
        }
        let mut at = last.to;
        for (index, step) in steps.iter().enumerate() {
            if step.from != at {
                return Err(CycleError::Gap {
                    step: index,
                    from: step.from,
                    to: at,
                });
            }
            board.go(&mut walk, index, step)?;
            at = step.to;
        }
        let residual = walk.motion.log();
        Ok(Self {
            steps,
            residual: residual.into(),
            covariance: walk.spread.upper(),
            chi2: walk.spread.chi2(&residual),
        })
    }

    /// Returns the closures after the first that the cycle leads over, by their edges.
    pub fn closures(&self) -> impl Iterator<Item = u32> {
        self.steps.iter().skip(1).filter_map(|step| step.over)
    }

    pub(super) fn gap(&self) -> Gap {
        let [xx, xy, xt, yy, yt, tt] = self.covariance;
        Gap {
            chi2: self.chi2,
            spread: Spread {
                xx,
                xy,
                xt,
                yy,
                yt,
                tt,
            },
        }
    }

    /// Returns the error of the cycle, χ², as if its first closure were exact. `truth` is the true
    /// displacement of its poses.
    pub(super) fn chi2_of_witnesses(
        &self,
        board: &Board<'_>,
        truth: Pose,
    ) -> Result<f64, CycleError> {
        let mut walk = Walk::begin();
        walk.go(&Motion::from(truth), &Spread::default());
        for (index, step) in self.steps.iter().enumerate().skip(1) {
            board.go(&mut walk, index, step)?;
        }
        Ok(walk.spread.chi2(&walk.motion.log()))
    }
}

/// Measured edges, from which cycles are composed.
pub(super) struct Board<'a> {
    pub(super) graph: &'a PoseGraph,
    pub(super) chain: &'a Chain,
    /// The measurement of each edge, with its covariance.
    measured: Vec<(Motion, Spread)>,
}

/// Product of measurements and its covariance, seen from the present pose.
struct Walk {
    motion: Motion,
    spread: Spread,
}

impl Walk {
    const fn begin() -> Self {
        Self {
            motion: Motion::NONE,
            spread: Spread {
                xx: 0.0,
                xy: 0.0,
                xt: 0.0,
                yy: 0.0,
                yt: 0.0,
                tt: 0.0,
            },
        }
    }

    fn go(&mut self, motion: &Motion, spread: &Spread) {
        self.motion = self.motion.then(motion);
        self.spread = self.spread.seen_from(&motion.inverse()).plus(spread);
    }
}

impl<'a> Board<'a> {
    pub(super) fn new(graph: &'a PoseGraph, chain: &'a Chain, config: &AuditConfig) -> Self {
        let edges = graph.edges().iter();
        let measured = edges.map(|edge| (Motion::from(edge.measured), spread_of(edge, config)));
        Self {
            graph,
            chain,
            measured: measured.collect(),
        }
    }

    fn go(&self, walk: &mut Walk, index: usize, step: &CycleStep) -> Result<(), CycleError> {
        if let Some(over) = step.over {
            let missing = CycleError::NoClosure {
                step: index,
                edge: over,
            };
            let edge = self.graph.edges().get(over as usize).ok_or(missing)?;
            let joins =
                [(edge.from, edge.to), (edge.to, edge.from)].contains(&(step.from, step.to));
            if !joins || edge.kind != PoseEdgeKind::Closure {
                return Err(missing);
            }
            self.cross(walk, over, step.from);
            return Ok(());
        }
        if step.from == step.to {
            return Err(CycleError::Nowhere { step: index });
        }
        let mut at = step.from;
        while at != step.to {
            let upper = if step.to > at {
                at.saturating_add(1)
            } else {
                at
            };
            let edge = self.chain.step_to(upper);
            let edge = edge.ok_or(CycleError::NoOdometry {
                step: index,
                pose: upper,
            })?;
            self.cross(walk, edge, at);
            at = if step.to > at { at + 1 } else { at - 1 };
        }
        Ok(())
    }

    /// Walks over an edge from the pose `from`.
    fn cross(&self, walk: &mut Walk, edge: u32, from: u32) {
        let (motion, spread) = &self.measured[edge as usize];
        match self.graph.edges()[edge as usize].from == from {
            true => walk.go(motion, spread),
            false => walk.go(&motion.inverse(), &spread.seen_from(motion)),
        }
    }
}
