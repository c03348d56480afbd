use alloc::vec::Vec;

use tolman_geom::Pose;

use super::system::LinearSystem;
use super::{PoseEdge, PoseEdgeKind, PoseGraph};
use crate::tangent::moved;

/// Parameters of the optimization of a graph of poses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OptimizerConfig {
    /// Maximum number of steps of Levenberg and Marquardt, at least 1.
    pub most_steps: u32,
    /// Maximum number of iterations of conjugate gradients in a step, at least 1.
    pub most_iterations: usize,
    /// Minimum relative reduction of the error by a step; below it the optimizer ends.
    pub tolerance: f64,
    /// Squared error at which a closure weighs a quarter; `None` to believe all closures.
    pub doubt: Option<f64>,
}

impl OptimizerConfig {
    /// Returns least squares: every edge is believed.
    #[must_use]
    pub const fn plain() -> Self {
        Self {
            most_steps: 50,
            most_iterations: 500,
            tolerance: 1e-9,
            doubt: None,
        }
    }

    /// Returns least squares that doubts closures. One in a thousand right closures, with three
    /// degrees of freedom, has a squared error above 16.
    #[must_use]
    pub const fn robust() -> Self {
        Self {
            doubt: Some(16.0),
            ..Self::plain()
        }
    }

    /// Returns an edge's part of the total cost, given its squared error χ² (Geman and McClure).
    fn cost(&self, edge: &PoseEdge, squared: f64) -> f64 {
        match (self.doubt, edge.kind) {
            (Some(doubt), PoseEdgeKind::Closure) => doubt * squared / (doubt + squared),
            _ => squared,
        }
    }

    /// Returns an edge's weight, given its squared error χ²: the derivative of its cost.
    fn weight(&self, edge: &PoseEdge, squared: f64) -> f64 {
        match (self.doubt, edge.kind) {
            (Some(doubt), PoseEdgeKind::Closure) => {
                let share = doubt / (doubt + squared);
                share * share
            }
            _ => 1.0,
        }
    }
}

/// Result of an optimization.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimized {
    /// Number of steps made.
    pub steps: u32,
    /// Sum of squared errors before, with doubted closures weighing less; no unit.
    pub error_before: f64,
    /// Error after the optimization; never larger than before.
    pub error_after: f64,
    /// Whether a further step would have changed next to nothing.
    pub has_converged: bool,
}

/// Damping of the first step.
const FIRST_DAMPING: f64 = 1e-6;
const MOST_DAMPING: f64 = 1e6;

impl PoseGraph {
    /// Moves all poses but the first to agree with the edges, and returns the result. It does not
    /// depend on the first pose.
    ///
    /// # Complexity
    /// O(steps · iterations · edges).
    pub fn optimize(&mut self, config: &OptimizerConfig) -> Optimized {
        let error_before = self.cost(&self.poses, config);
        let mut optimized = Optimized {
            steps: 0,
            error_before,
            error_after: error_before,
            has_converged: false,
        };
        let mut damping = FIRST_DAMPING;
        while optimized.steps < config.most_steps && !optimized.has_converged {
            optimized.steps += 1;
            let before = optimized.error_after;
            match self.step(config, before, &mut damping) {
                Some(after) => {
                    optimized.error_after = after;
                    optimized.has_converged = before - after <= config.tolerance * before;
                }
                // No step leads down any more.
                None => optimized.has_converged = true,
            }
        }
        optimized
    }

    /// Takes one step that reduces the error, and returns the new error; `None` if the damping
    /// allows no such step.
    fn step(&mut self, config: &OptimizerConfig, before: f64, damping: &mut f64) -> Option<f64> {
        let weight = |edge: &PoseEdge, squared| config.weight(edge, squared);
        let system = LinearSystem::about(&self.poses, &self.edges, weight);
        while *damping <= MOST_DAMPING {
            let steps = system.solve(*damping, config.most_iterations);
            let pairs = self.poses.iter().zip(&steps);
            let poses: Vec<Pose> = pairs.map(|(pose, step)| moved(*pose, step)).collect();
            let after = self.cost(&poses, config);
            if after < before {
                *damping = (*damping * 0.1).max(FIRST_DAMPING);
                self.poses = poses;
                return Some(after);
            }
            *damping *= 10.0;
        }
        None
    }

    fn cost(&self, poses: &[Pose], config: &OptimizerConfig) -> f64 {
        let cost = |edge: &PoseEdge| {
            let squared = edge.squared_error(poses[edge.from as usize], poses[edge.to as usize]);
            config.cost(edge, squared)
        };
        self.edges.iter().map(cost).sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::nalgebra::{Matrix3, Vector3};
    use tolman_geom::{Heading, Point};

    use super::*;

    fn pose(x: f64, y: f64, heading: f64) -> Pose {
        Pose::new(Point::new(x, y), Heading::from_radians(heading))
    }

    fn edge(from: u32, to: u32, measured: Pose, kind: PoseEdgeKind) -> PoseEdge {
        let information = Matrix3::from_diagonal(&Vector3::new(100.0, 100.0, 400.0));
        PoseEdge {
            from,
            to,
            measured,
            information,
            kind,
        }
    }

    type Errors = Vec<(f64, f64, f64)>;

    /// Returns a graph round a circle, whose odometry and closures err by `errors`. Some of the
    /// closures are wrong.
    fn way(errors: &Errors, lies: usize, first: Pose) -> (Vec<Pose>, PoseGraph) {
        let count = errors.len() as u32;
        let along = |index: u32| 0.4 * f64::from(index);
        let truth: Vec<Pose> = (0..count)
            .map(|index| {
                let (sin, cos) = libm::sincos(along(index));
                pose(2.0 * sin, 2.0 - 2.0 * cos, along(index))
            })
            .collect();
        let erring = |from: usize, to: usize| {
            let (x, y, turn) = errors[to];
            truth[from]
                .between(truth[to])
                .compose(pose(0.02 * x, 0.02 * y, 0.02 * turn))
        };
        let mut graph = PoseGraph::new();
        graph.add_pose(first);
        for to in 1..truth.len() {
            let measured = erring(to - 1, to);
            let reckoned = graph.poses()[to - 1].compose(measured);
            graph.add_pose(reckoned);
            let (from, to) = (to as u32 - 1, to as u32);
            graph
                .add_edge(edge(from, to, measured, PoseEdgeKind::Odometry))
                .unwrap();
        }
        // Once round are 15.7 poses.
        for to in 16..truth.len() {
            let measured = erring(to - 16, to);
            let (from, to) = (to as u32 - 16, to as u32);
            graph
                .add_edge(edge(from, to, measured, PoseEdgeKind::Closure))
                .unwrap();
        }
        for lie in 0..lies as u32 {
            let (from, to) = (lie, count - 1 - 2 * lie);
            graph
                .add_edge(edge(from, to, Pose::IDENTITY, PoseEdgeKind::Closure))
                .unwrap();
        }
        (truth, graph)
    }

    fn errors() -> impl Strategy<Value = Errors> {
        let part = -1.0..1.0;
        proptest::collection::vec((part.clone(), part.clone(), part), 20..40)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn the_solution_does_not_depend_on_the_gauge(
            errors in errors(), x in -9.0..9.0, y in -9.0..9.0, heading in -3.0..3.0,
        ) {
            let (_, mut here) = way(&errors, 0, Pose::IDENTITY);
            let first = pose(x, y, heading);
            let (_, mut there) = way(&errors, 0, first);
            let config = OptimizerConfig::robust();
            let (a, b) = (here.optimize(&config), there.optimize(&config));
            prop_assert!((a.error_after - b.error_after).abs() < 1e-6 * (1.0 + a.error_after));
            for (here, there) in here.poses().iter().zip(there.poses()) {
                let off = first.compose(*here).between(*there);
                prop_assert!(off.position.coords.norm() < 1e-4);
                prop_assert!(off.heading.radians().abs() < 1e-4);
            }
        }

        #[test]
        fn an_edge_that_agrees_never_raises_the_error(
            errors in errors(), from in 0_u32..20, to in 0_u32..20, robust: bool,
        ) {
            prop_assume!(from != to);
            let config = if robust { OptimizerConfig::robust() } else { OptimizerConfig::plain() };
            let (_, mut graph) = way(&errors, 0, Pose::IDENTITY);
            let before = graph.optimize(&config).error_after;
            let measured = graph.poses()[from as usize].between(graph.poses()[to as usize]);
            graph.add_edge(edge(from, to, measured, PoseEdgeKind::Closure)).unwrap();
            let after = graph.optimize(&config).error_after;
            prop_assert!(after <= before + 1e-12);
        }

        #[test]
        fn optimizing_brings_the_poses_nearer_to_the_truth(errors in errors()) {
            let (truth, mut graph) = way(&errors, 0, Pose::IDENTITY);
            let off = |graph: &PoseGraph| -> f64 {
                let pairs = graph.poses().iter().zip(&truth);
                pairs.map(|(pose, truth)| (pose.position - truth.position).norm_squared()).sum()
            };
            let before = off(&graph);
            prop_assume!(before > 0.5);
            graph.optimize(&OptimizerConfig::plain());
            prop_assert!(off(&graph) < before);
        }
    }

    #[test]
    fn closures_that_lie_are_doubted() {
        let errors: Errors = (0..40)
            .map(|n| (f64::from(n % 3) - 1.0, f64::from(n % 5) * 0.4 - 0.8, 0.3))
            .collect();
        let (truth, honest) = way(&errors, 0, Pose::IDENTITY);
        let (_, lied_to) = way(&errors, 6, Pose::IDENTITY);
        let worst = |mut graph: PoseGraph, config: OptimizerConfig| {
            graph.optimize(&config);
            let pairs = graph.poses().iter().zip(&truth);
            pairs
                .map(|(pose, truth)| (pose.position - truth.position).norm())
                .fold(0.0, f64::max)
        };
        let told_the_truth = worst(honest, OptimizerConfig::plain());
        let believing = worst(lied_to.clone(), OptimizerConfig::plain());
        let doubting = worst(lied_to, OptimizerConfig::robust());
        assert!(believing > 1.0, "{believing}");
        assert!(
            doubting < 2.0 * told_the_truth + 0.05,
            "{doubting}, {told_the_truth}"
        );
    }

    #[test]
    fn edges_that_measure_nothing_are_refused() {
        use super::super::PoseGraphError as Error;
        let mut graph = PoseGraph::new();
        graph.add_pose(Pose::IDENTITY);
        graph.add_pose(Pose::IDENTITY);
        let sound = edge(0, 1, Pose::IDENTITY, PoseEdgeKind::Closure);
        let refuse = |graph: &mut PoseGraph, edge| graph.add_edge(edge).unwrap_err();
        let far = PoseEdge { to: 2, ..sound };
        assert_eq!(
            refuse(&mut graph, far),
            Error::NoPose {
                from: 0,
                to: 2,
                poses: 2
            }
        );
        let own = PoseEdge { to: 0, ..sound };
        assert_eq!(refuse(&mut graph, own), Error::Loop { pose: 0 });
        let nowhere = PoseEdge {
            measured: pose(f64::NAN, 0.0, 0.0),
            ..sound
        };
        assert_eq!(
            refuse(&mut graph, nowhere),
            Error::NotFinite { from: 0, to: 1 }
        );
        let negative = PoseEdge {
            information: -Matrix3::identity(),
            ..sound
        };
        assert_eq!(
            refuse(&mut graph, negative),
            Error::Information { from: 0, to: 1 }
        );
        assert!(graph.edges().is_empty());
    }
}
