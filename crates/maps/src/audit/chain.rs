//! Sums up the odometry so that any span of it costs O(1).

use alloc::vec::Vec;

use tolman_geom::Pose;

use super::motion::{Motion, Spread};
use super::{AuditConfig, AuditError};
use crate::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};

/// Poses by odometry alone, with the sums of its covariances.
pub(super) struct Chain {
    /// Pose by odometry, relative to the first pose of its piece.
    pub(super) reckoned: Vec<Motion>,
    /// Summed covariance of all steps up to each pose, seen from the first pose of its piece.
    summed: Vec<Spread>,
    /// Way driven up to each pose, m.
    pub(super) driven: Vec<f64>,
    /// The summed cost of all steps up to each pose.
    cost: Vec<f64>,
    /// Unbroken piece of the odometry to which each pose belongs.
    piece: Vec<u32>,
    /// The edge that leads to each pose from the one before.
    step: Vec<Option<u32>>,
}

impl Chain {
    /// Returns the sums over a graph's odometry. If two odometry edges join the same poses, the
    /// first counts. O(poses + edges).
    pub(super) fn of(graph: &PoseGraph, config: &AuditConfig) -> Result<Self, AuditError> {
        let step = steps(graph)?;
        let mut chain = Self {
            reckoned: Vec::with_capacity(step.len()),
            summed: Vec::with_capacity(step.len()),
            driven: Vec::with_capacity(step.len()),
            cost: Vec::with_capacity(step.len()),
            piece: Vec::with_capacity(step.len()),
            step,
        };
        let mut pose = Pose::IDENTITY;
        for to in 0..chain.step.len() {
            match chain.step[to] {
                Some(edge) if to > 0 => {
                    let edge = &graph.edges()[edge as usize];
                    let (measured, spread) = forward(edge, config);
                    pose = pose.compose(measured);
                    chain.go_on(pose, &spread, config);
                    chain.drive(measured.position.coords.norm());
                }
                _ => {
                    pose = Pose::IDENTITY;
                    chain.begin();
                    chain.drive(0.0);
                }
            }
        }
        Ok(chain)
    }

    fn begin(&mut self) {
        self.piece
            .push(self.piece.last().map_or(0, |last| last + 1));
        self.reckoned.push(Motion::NONE);
        self.summed.push(Spread::default());
        self.cost.push(self.cost.last().copied().unwrap_or(0.0));
    }

    fn go_on(&mut self, pose: Pose, spread: &Spread, config: &AuditConfig) {
        let motion = Motion::from(pose);
        let (Some(summed), Some(cost), Some(piece)) =
            (self.summed.last(), self.cost.last(), self.piece.last())
        else {
            return;
        };
        let (summed, cost, piece) = (
            summed.plus(&spread.seen_from(&motion)),
            cost + cost_of(spread, config),
            *piece,
        );
        self.summed.push(summed);
        self.cost.push(cost);
        self.piece.push(piece);
        self.reckoned.push(motion);
    }

    fn drive(&mut self, way: f64) {
        self.driven.push(self.driven.last().unwrap_or(&0.0) + way);
    }

    /// Returns the factor on the bound of the span between two poses. The errors of wheels are not
    /// independent of each other over long ways.
    pub(super) fn doubt(&self, a: u32, b: u32, config: &AuditConfig) -> f64 {
        let way = (self.driven[a as usize] - self.driven[b as usize]).abs();
        1.0 + way / config.white_way
    }

    /// Returns whether odometry leads from one pose to the other.
    pub(super) fn joins(&self, a: u32, b: u32) -> bool {
        self.piece[a as usize] == self.piece[b as usize]
    }

    /// Returns the covariance of the span between two poses of one piece, seen from the first of
    /// the piece. O(1).
    pub(super) fn span(&self, a: u32, b: u32) -> Spread {
        let (low, high) = (a.min(b) as usize, a.max(b) as usize);
        self.summed[high].minus(&self.summed[low])
    }

    /// Returns the cost of the span between two poses of one piece. O(1).
    pub(super) fn span_cost(&self, a: u32, b: u32) -> f64 {
        (self.cost[a as usize] - self.cost[b as usize]).abs()
    }

    /// Returns the edge that leads to a pose from the one before.
    pub(super) fn step_to(&self, pose: u32) -> Option<u32> {
        self.step.get(pose as usize).copied().flatten()
    }
}

/// Returns the motion and covariance of an odometry edge from the lower pose to the higher.
pub(super) fn forward(edge: &PoseEdge, config: &AuditConfig) -> (Pose, Spread) {
    let spread = spread_of(edge, config);
    if edge.from < edge.to {
        return (edge.measured, spread);
    }
    let spread = spread.seen_from(&Motion::from(edge.measured));
    (edge.measured.inverse(), spread)
}

/// Returns the covariance of an edge in the frame of the pose it leads to.
pub(super) fn spread_of(edge: &PoseEdge, config: &AuditConfig) -> Spread {
    let covariance = edge.information.try_inverse().unwrap_or_default();
    Spread::of(&covariance).scaled(config.sigma_scale * config.sigma_scale)
}

/// Returns the cost of an edge in the search for the surest way.
pub(super) fn cost_of(spread: &Spread, config: &AuditConfig) -> f64 {
    spread.xx + spread.yy + config.lever * config.lever * spread.tt
}

/// Returns the first odometry edge to each pose from the one before.
fn steps(graph: &PoseGraph) -> Result<Vec<Option<u32>>, AuditError> {
    let mut steps = alloc::vec![None; graph.poses().len()];
    for (index, edge) in (0..).zip(graph.edges()) {
        if edge.kind == PoseEdgeKind::Odometry {
            let (low, high) = (edge.from.min(edge.to), edge.from.max(edge.to));
            if high != low + 1 {
                return Err(AuditError::Odometry {
                    edge: index,
                    from: edge.from,
                    to: edge.to,
                });
            }
            let step: &mut Option<u32> = &mut steps[high as usize];
            step.get_or_insert(index);
        }
    }
    Ok(steps)
}
