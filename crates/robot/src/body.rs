use alloc::vec::Vec;

use tolman_geom::Point;

/// The outline of a robot, in its own frame.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Body {
    /// A disc round the robot's origin.
    Circle {
        /// Radius of the disc, m.
        radius: f64,
    },
    /// A convex outline.
    Polygon {
        /// Corners of the polygon in counter-clockwise order, m.
        corners: Vec<Point>,
    },
}

impl Body {
    /// Returns the radius of the smallest disc round the robot's origin that holds the body, m: the
    /// room it needs to turn in place.
    ///
    /// ```
    /// use tolman_geom::Point;
    /// use tolman_robot::Body;
    ///
    /// let corners = vec![
    ///     Point::new(-0.1, -0.2),
    ///     Point::new(0.3, -0.2),
    ///     Point::new(0.3, 0.4),
    ///     Point::new(-0.1, 0.4),
    /// ];
    /// let body = Body::Polygon { corners };
    /// assert!((body.radius() - 0.5).abs() < 1e-12, "the far corner is 0.3 ahead and 0.4 left");
    /// ```
    #[must_use]
    pub fn radius(&self) -> f64 {
        match self {
            Self::Circle { radius } => *radius,
            Self::Polygon { corners } => corners
                .iter()
                .map(|corner| corner.coords.norm())
                .fold(0.0, f64::max),
        }
    }
}
