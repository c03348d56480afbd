use tolman_geom::nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use tolman_geom::{Heading, Pose};

use crate::tangent::difference;

/// A measurement between two poses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseEdge {
    /// Pose from which the edge was measured.
    pub from: u32,
    /// Pose that was measured.
    pub to: u32,
    /// Pose of `to` relative to `from`.
    pub measured: Pose,
    /// The inverse of the measurement's covariance: x and y in m, ahead and to the left of the
    /// measured pose, and the heading in rad.
    pub information: Matrix3<f64>,
    /// Kind of measurement, which decides whether the edge may be entirely wrong.
    pub kind: PoseEdgeKind,
}

/// Kind of a measurement, which decides whether it may be entirely wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PoseEdgeKind {
    /// Odometry, which has errors but is never entirely wrong.
    Odometry,
    /// A recognized place, which may be mistaken.
    Closure,
}

/// Derivative of an edge's error by the two poses, each moved in its own frame.
pub(super) struct Linearized {
    pub(super) error: Vector3<f64>,
    pub(super) by_from: Matrix3<f64>,
    pub(super) by_to: Matrix3<f64>,
}

impl PoseEdge {
    /// Returns the difference of `to` from its measured pose: x and y, m, and the heading, rad.
    #[must_use]
    pub fn error(&self, from: Pose, to: Pose) -> Vector3<f64> {
        difference(self.measured, from.between(to))
    }

    /// Returns the squared error, weighted by the information: χ².
    #[must_use]
    pub fn squared_error(&self, from: Pose, to: Pose) -> f64 {
        let error = self.error(from, to);
        (self.information * error).dot(&error)
    }

    pub(super) fn linearize(&self, from: Pose, to: Pose) -> Linearized {
        let seen = from.between(to).position;
        let error = self.error(from, to);
        let unmeasure = rotation(self.measured.heading).transpose();
        let turned = unmeasure * Vector2::new(seen.y, -seen.x);
        let by_to = block(
            rotation(Heading::from_radians(error.z)),
            Vector2::zeros(),
            1.0,
        );
        Linearized {
            error,
            by_from: block(-unmeasure, turned, -1.0),
            by_to,
        }
    }
}

fn rotation(heading: Heading) -> Matrix2<f64> {
    let unit = heading.unit();
    Matrix2::new(unit.x, -unit.y, unit.y, unit.x)
}

/// Returns two derivatives: of the position by position and by heading, and of the heading by
/// heading.
fn block(position: Matrix2<f64>, by_heading: Vector2<f64>, heading: f64) -> Matrix3<f64> {
    let mut all = Matrix3::zeros();
    all.fixed_view_mut::<2, 2>(0, 0).copy_from(&position);
    all.fixed_view_mut::<2, 1>(0, 2).copy_from(&by_heading);
    all[(2, 2)] = heading;
    all
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Point;

    use super::*;
    use crate::tangent::moved;

    fn pose() -> impl Strategy<Value = Pose> {
        let part = -5.0..5.0;
        (part.clone(), part, -3.0..3.0).prop_map(|(x, y, heading): (f64, f64, f64)| {
            Pose::new(Point::new(x, y), Heading::from_radians(heading))
        })
    }

    proptest! {
        #[test]
        fn an_edge_changes_as_its_linearization_says((from, to, off) in (pose(), pose(), pose())) {
            let measured = from.between(to);
            let off = Pose::new(off.position * 0.05, Heading::from_radians(0.05 * off.heading.radians()));
            let edge = PoseEdge {
                from: 0,
                to: 1,
                measured: measured.compose(off),
                information: Matrix3::identity(),
                kind: PoseEdgeKind::Odometry,
            };
            let linear = edge.linearize(from, to);
            for part in 0..3 {
                let mut step = Vector3::zeros();
                step[part] = 1e-6;
                let by_from = (edge.error(moved(from, &step), to) - linear.error) / 1e-6;
                let by_to = (edge.error(from, moved(to, &step)) - linear.error) / 1e-6;
                prop_assert!((by_from - linear.by_from.column(part)).norm() < 1e-4);
                prop_assert!((by_to - linear.by_to.column(part)).norm() < 1e-4);
            }
        }
    }
}
