//! Poses rounded to whole numbers.

use core::f64::consts::{PI, TAU};

use tolman_geom::{Point, Pose};
use tolman_sim::Bounds;

/// Maximum value of a coordinate: the far edge of the rectangle.
const FAR: f64 = 65535.0;

/// Number by which a full turn is coded; it equals 0.
const TURN: f64 = 65536.0;

/// Returns a pose inside a rectangle as x, y and heading, rounded to 16 bits each.
///
/// A coordinate is off by at most half of 1/65535 of the rectangle's side: 0.13 mm in a maze of 17
/// m. A heading is off by at most π/65536 (0.003°).
pub(super) fn rounded(&Bounds { min, max }: &Bounds, pose: Pose) -> [u16; 3] {
    let share = |value: f64, min: f64, max: f64| {
        let extent = max - min;
        if extent > 0.0 {
            libm::round((value - min) / extent * FAR) as u16
        } else {
            0
        }
    };
    let turn = libm::round((pose.heading.radians() + PI) / TAU * TURN);
    [
        share(pose.position.x, min.x, max.x),
        share(pose.position.y, min.y, max.y),
        (turn as u32 & 0xffff) as u16,
    ]
}

/// Returns the smallest rectangle that holds all points. For a single point or none, it is one
/// metre wide and high.
pub(super) fn bounds_of(points: impl IntoIterator<Item = Point>) -> Bounds {
    let bounds = Bounds::of(points);
    if bounds.width() > 0.0 || bounds.height() > 0.0 {
        return bounds;
    }
    let min = if bounds.min.x.is_finite() {
        bounds.min
    } else {
        Point::origin()
    };
    Bounds {
        min,
        max: Point::new(min.x + 1.0, min.y + 1.0),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Heading;

    use super::*;

    /// Returns the pose that the player decodes.
    fn decode(bounds: Bounds, numbers: [u16; 3]) -> Pose {
        let [x, y, h] = numbers.map(f64::from);
        let position = Point::new(
            bounds.min.x + bounds.width() * x / FAR,
            bounds.min.y + bounds.height() * y / FAR,
        );
        Pose::new(position, Heading::from_radians(h / TURN * TAU - PI))
    }

    proptest! {
        #[test]
        fn a_pose_is_off_by_half_a_quantum_at_most(
            corner in (-1e3_f64..1e3, -1e3_f64..1e3),
            size in (0.01_f64..1e3, 0.01_f64..1e3),
            share in (0.0_f64..=1.0, 0.0_f64..=1.0),
            heading in -10.0_f64..10.0,
        ) {
            let min = Point::new(corner.0, corner.1);
            let bounds = Bounds { min, max: Point::new(min.x + size.0, min.y + size.1) };
            let position = Point::new(
                (min.x + size.0 * share.0).min(bounds.max.x),
                (min.y + size.1 * share.1).min(bounds.max.y),
            );
            let pose = Pose::new(position, Heading::from_radians(heading));
            let again = decode(bounds, rounded(&bounds, pose));
            let off = again.position - pose.position;
            let slack = 1.0 + 1e-6;
            prop_assert!(off.x.abs() <= 0.5 * bounds.width() / FAR * slack);
            prop_assert!(off.y.abs() <= 0.5 * bounds.height() / FAR * slack);
            prop_assert!(again.heading.turn_to(pose.heading).abs() <= PI / TURN * slack);
        }
    }

    #[test]
    fn the_edges_are_exact_and_west_has_one_code() {
        let bounds = Bounds {
            min: Point::new(-1.0, 2.0),
            max: Point::new(3.0, 2.0),
        };
        let west = rounded(&bounds, Pose::new(bounds.max, Heading::WEST));
        assert_eq!(west, [0xffff, 0, 0]);
        assert!((decode(bounds, west).position - bounds.max).norm() < 1e-12);
    }
}
