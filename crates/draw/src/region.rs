//! Regions where something may be: boxes and ellipses.

use tolman_geom::{Heading, Point, Pose};
use tolman_sim::Bounds;

/// A region that contains something at an uncertain position, for
/// [`FloorPlan::region`](super::FloorPlan::region).
///
/// ```
/// use tolman_draw::{FloorPlan, Region, Series};
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_sim::Bounds;
///
/// let bounds = Bounds { min: Point::new(-1.0, -1.0), max: Point::new(3.0, 2.0) };
/// let mut plan = FloorPlan::of_bounds(&bounds, 420.0);
/// // An interval in x and y, a box along a heading, and two standard deviations of a Gaussian.
/// plan.region(&Region::within(&Bounds { min: Point::new(0.0, 0.0), max: Point::new(0.4, 0.2) }), Series(0));
/// let pose = Pose::new(Point::new(1.0, 1.0), Heading::from_degrees(30.0));
/// plan.region(&Region::Box { pose, length: 0.6, width: 0.2 }, Series(1));
/// let covariance = [[0.04, 0.01], [0.01, 0.02]];
/// plan.region(&Region::of_covariance(Point::new(2.0, 0.5), covariance, 2.0), Series(2));
/// let drawing = plan.drawing("Three places that are known with different uncertainty.");
/// # assert_eq!(drawing.body.into_string().matches("uncertain").count(), 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// A box with its middle at a pose, along the pose's heading.
    Box {
        /// Pose of the box's middle.
        pose: Pose,
        /// Extent along the heading, m.
        length: f64,
        /// Extent across the heading, m.
        width: f64,
    },
    /// An ellipse with its middle at a pose, one axis along the pose's heading.
    Ellipse {
        /// Pose of the ellipse's middle.
        pose: Pose,
        /// Half the extent along the heading, m.
        along: f64,
        /// Half the extent across the heading, m.
        across: f64,
    },
}

impl Region {
    /// Returns a box along the axes of the world.
    pub fn within(bounds: &Bounds) -> Self {
        let middle = bounds.min + 0.5 * (bounds.max - bounds.min);
        Self::Box {
            pose: Pose::new(middle, Heading::EAST),
            length: bounds.max.x - bounds.min.x,
            width: bounds.max.y - bounds.min.y,
        }
    }

    /// Returns the ellipse of `deviations` standard deviations around the mean of a Gaussian. Its
    /// semi-axes are the square roots of the covariance's eigenvalues, times `deviations`.
    ///
    /// An eigenvalue that rounding has made negative counts as 0. If the two entries off the
    /// diagonal differ, their mean counts.
    pub fn of_covariance(mean: Point, covariance: [[f64; 2]; 2], deviations: f64) -> Self {
        let [[xx, xy], [yx, yy]] = covariance;
        let xy = f64::midpoint(xy, yx);
        let half_trace = f64::midpoint(xx, yy);
        let half_difference = 0.5 * (xx - yy);
        let root = libm::hypot(half_difference, xy);
        let half_axis = |eigenvalue: f64| deviations * eigenvalue.max(0.0).sqrt();
        // The direction of the larger eigenvalue.
        let angle = 0.5 * libm::atan2(xy, half_difference);
        Self::Ellipse {
            pose: Pose::new(mean, Heading::from_radians(angle)),
            along: half_axis(half_trace + root),
            across: half_axis(half_trace - root),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_long_axis_of_an_ellipse_follows_the_covariance() {
        // Standard deviations 3 along 30° and 1 across, by hand: R diag(9, 1) Rᵀ.
        let (sin, cos) = (0.5, 0.75_f64.sqrt());
        let xy = 8.0 * sin * cos;
        let covariance = [[9.0 * 0.75 + 0.25, xy], [xy, 9.0 * 0.25 + 0.75]];
        let Region::Ellipse {
            pose,
            along,
            across,
        } = Region::of_covariance(Point::origin(), covariance, 2.0)
        else {
            panic!("no ellipse")
        };
        assert!((along - 6.0).abs() < 1e-12 && (across - 2.0).abs() < 1e-12);
        assert!((pose.heading.radians().to_degrees() - 30.0).abs() < 1e-9);
    }

    #[test]
    fn a_degenerate_covariance_is_a_line() {
        let flat = [[1.0, 1.0], [1.0, 1.0 - 1e-15]];
        let Region::Ellipse { across, .. } = Region::of_covariance(Point::origin(), flat, 1.0)
        else {
            panic!("no ellipse")
        };
        assert!((0.0..1e-6).contains(&across));
    }
}
