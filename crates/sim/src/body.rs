use thiserror::Error;
use tolman_geom::Point;
use tolman_robot::Body;

/// Reason why a body is invalid.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The radius of a disc is not a positive number.
    #[error("the body's radius is {radius} m; give a positive number of metres")]
    Radius {
        /// The offending radius, m.
        radius: f64,
    },
    /// A polygon has fewer than three corners.
    #[error("the body's outline has {count} corners; give at least three")]
    Corners {
        /// Number of corners.
        count: usize,
    },
    /// A polygon turns right (or not at all) at a corner, or a corner is not a number.
    #[error(
        "the body's outline does not turn left at corner {index} ({x}, {y}) m; give the corners of a \
         convex outline counter-clockwise round the robot's origin"
    )]
    NotConvex {
        /// Number of the corner, from 0.
        index: usize,
        /// x of the corner, m.
        x: f64,
        /// y of the corner, m.
        y: f64,
    },
}

/// Checks that a body can be simulated: a disc of positive radius, or a convex outline round the
/// robot's origin.
pub(crate) fn check(body: &Body) -> Result<(), BodyError> {
    match body {
        Body::Circle { radius } => {
            if !(radius.is_finite() && *radius > 0.0) {
                return Err(BodyError::Radius { radius: *radius });
            }
        }
        Body::Polygon { corners } => {
            let count = corners.len();
            if count < 3 {
                return Err(BodyError::Corners { count });
            }
            for (index, corner) in corners.iter().enumerate() {
                let next = corners[(index + 1) % count];
                let after = corners[(index + 2) % count];
                let turns_left = (next - corner).perp(&(after - next)) > 0.0;
                let origin_inside = (next - corner).perp(&(Point::origin() - corner)) > 0.0;
                if !(turns_left && origin_inside) {
                    return Err(BodyError::NotConvex {
                        index,
                        x: corner.x,
                        y: corner.y,
                    });
                }
            }
        }
    }
    Ok(())
}
