use alloc::vec::Vec;

use tolman_geom::Pose;

use super::{PoseEdge, PoseEdgeKind, PoseGraphError};

/// Poses, and what was measured between them.
///
/// ```
/// use tolman_maps::geom::nalgebra::Matrix3;
/// use tolman_maps::geom::{Heading, Point, Pose};
/// use tolman_maps::pose_graph::{PoseEdgeKind, OptimizerConfig, PoseEdge, PoseGraph};
///
/// // Round a square of 1 m, by wheels that turn 5° too far at each corner.
/// let side = |degrees: f64| Pose::new(Point::new(1.0, 0.0), Heading::from_degrees(degrees));
/// let edge = |from, to, measured, kind| PoseEdge { from, to, measured, information: Matrix3::identity() * 100.0, kind };
/// let mut graph = PoseGraph::new();
/// graph.add_pose(Pose::IDENTITY);
/// for corner in 0..4 {
///     let reckoned = graph.poses()[corner as usize].compose(side(95.0));
///     graph.add_pose(reckoned);
///     graph.add_edge(edge(corner, corner + 1, side(95.0), PoseEdgeKind::Odometry))?;
/// }
/// assert!(graph.poses()[4].position.coords.norm() > 0.1);
/// // It is back where it was.
/// graph.add_edge(edge(0, 4, Pose::IDENTITY, PoseEdgeKind::Closure))?;
/// let optimized = graph.optimize(&OptimizerConfig::robust());
/// assert!(optimized.error_after < optimized.error_before);
/// assert!(graph.poses()[4].position.coords.norm() < 0.1);
/// # Ok::<(), tolman_maps::pose_graph::PoseGraphError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseGraph {
    pub(super) poses: Vec<Pose>,
    pub(super) edges: Vec<PoseEdge>,
}

impl PoseGraph {
    /// Returns a graph without poses.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            poses: Vec::new(),
            edges: Vec::new(),
        }
    }

    /// Returns the poses, by id. The first never moves; the others are relative to it.
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Returns the edges, in the order they were added.
    #[must_use]
    pub fn edges(&self) -> &[PoseEdge] {
        &self.edges
    }

    /// Returns the edges that are closures, in the order they were added. O(edges).
    pub fn closures(&self) -> impl Iterator<Item = &PoseEdge> {
        let edges = self.edges.iter();
        edges.filter(|edge| edge.kind == PoseEdgeKind::Closure)
    }

    /// Adds a pose at its believed position, and returns its id.
    pub fn add_pose(&mut self, pose: Pose) -> u32 {
        self.poses.push(pose);
        self.poses.len() as u32 - 1
    }

    /// Adds a measurement between two poses.
    ///
    /// # Errors
    /// If there are no such poses, they are the same, a number is not finite, or the information is
    /// not positive definite.
    pub fn add_edge(&mut self, edge: PoseEdge) -> Result<(), PoseGraphError> {
        let PoseEdge { from, to, .. } = edge;
        let poses = self.poses.len();
        if from as usize >= poses || to as usize >= poses {
            return Err(PoseGraphError::NoPose { from, to, poses });
        }
        if from == to {
            return Err(PoseGraphError::Loop { pose: from });
        }
        let information = edge.information;
        if !edge.measured.is_finite() || !information.iter().all(|number| number.is_finite()) {
            return Err(PoseGraphError::NotFinite { from, to });
        }
        let asymmetry = (information - information.transpose()).abs().max();
        if asymmetry > 1e-9 * information.abs().max() || information.cholesky().is_none() {
            return Err(PoseGraphError::Information { from, to });
        }
        self.edges.push(edge);
        Ok(())
    }

    /// Moves a pose to `pose`. Does nothing if `id` does not exist, if it is the first, which never
    /// moves, or if `pose` is not finite.
    pub fn move_pose(&mut self, id: u32, pose: Pose) {
        if id > 0
            && pose.is_finite()
            && let Some(old) = self.poses.get_mut(id as usize)
        {
            *old = pose;
        }
    }

    /// Replaces the measurement of every closure by its poses' present relation, after its source
    /// was corrected. O(edges).
    pub fn measure_closures_anew(&mut self) {
        for edge in &mut self.edges {
            if edge.kind == PoseEdgeKind::Closure {
                let [from, to] = [edge.from, edge.to].map(|id| self.poses[id as usize]);
                edge.measured = from.between(to);
            }
        }
    }

    /// Returns the squared error of an edge under the poses as they are, weighted by its
    /// information; `None` if there is no such edge.
    #[must_use]
    pub fn squared_error(&self, edge: usize) -> Option<f64> {
        let edge = self.edges.get(edge)?;
        Some(edge.squared_error(self.poses[edge.from as usize], self.poses[edge.to as usize]))
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::nalgebra::{Matrix3, Vector3};
    use tolman_geom::{Heading, Point};

    use super::*;

    #[test]
    fn the_error_of_an_edge_is_weighted_by_its_information() {
        let mut graph = PoseGraph::new();
        graph.add_pose(Pose::IDENTITY);
        graph.add_pose(Pose::new(Point::new(1.0, 2.0), Heading::EAST));
        let edge = PoseEdge {
            from: 0,
            to: 1,
            measured: Pose::new(Point::new(1.5, 1.0), Heading::EAST),
            information: Matrix3::from_diagonal(&Vector3::new(4.0, 9.0, 1.0)),
            kind: PoseEdgeKind::Closure,
        };
        graph.add_edge(edge).unwrap();
        // Half a metre and a metre off.
        let error = graph.squared_error(0).unwrap();
        assert!((error - (4.0 * 0.25 + 9.0)).abs() < 1e-12, "{error}");
        assert_eq!(graph.squared_error(1), None);
        graph.measure_closures_anew();
        assert!(graph.squared_error(0).unwrap().abs() < 1e-12);
        // The first pose stays.
        graph.move_pose(0, graph.poses()[1]);
        assert_eq!(graph.poses()[0], Pose::IDENTITY);
        graph.move_pose(1, Pose::IDENTITY);
        assert_eq!(graph.poses()[1], Pose::IDENTITY);
    }
}
