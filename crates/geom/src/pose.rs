use nalgebra::{Isometry2, UnitComplex};

use crate::{Heading, Point, Twist, Vector};

/// A position and a heading. It is also the rigid transform from its own frame to the frame it is
/// given in: `world_from_robot.transform(point_in_robot)` is the point in the world.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
///
/// let world_from_robot = Pose::new(Point::new(3.0, 1.0), Heading::NORTH);
/// let robot_from_laser = Pose::new(Point::new(0.1, 0.0), Heading::EAST);
/// let world_from_laser = world_from_robot.compose(robot_from_laser);
/// assert!((world_from_laser.position - Point::new(3.0, 1.1)).norm() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Position in the outer frame, m.
    pub position: Point,
    /// Heading in the outer frame, rad counter-clockwise from east.
    pub heading: Heading,
}

impl Pose {
    /// The origin, looking east.
    pub const IDENTITY: Self = Self::new(Point::new(0.0, 0.0), Heading::EAST);

    /// Returns a pose from its parts.
    #[must_use]
    pub const fn new(position: Point, heading: Heading) -> Self {
        Self { position, heading }
    }

    /// Returns `a_from_c` for `a_from_b.compose(b_from_c)`.
    #[inline]
    #[must_use]
    pub fn compose(self, inner: Self) -> Self {
        Self::new(
            self.transform(inner.position),
            self.heading.turned(inner.heading.radians()),
        )
    }

    /// Returns `b_from_a` for `a_from_b.inverse()`.
    #[inline]
    #[must_use]
    pub fn inverse(self) -> Self {
        let heading = Heading::from_radians(-self.heading.radians());
        Self {
            position: Point::from(-heading.rotate(self.position.coords)),
            heading,
        }
    }

    /// Returns the pose of `other` as seen from this one: `world_from_a.between(world_from_b)` is
    /// `a_from_b`.
    #[inline]
    #[must_use]
    pub fn between(self, other: Self) -> Self {
        self.inverse().compose(other)
    }

    /// Returns a point of this pose's own frame, in the frame the pose is given in.
    #[inline]
    #[must_use]
    pub fn transform(self, point: Point) -> Point {
        self.position + self.heading.rotate(point.coords)
    }

    /// Returns the pose at which a body arrives that starts here and keeps `twist` for `seconds`,
    /// s: the exact arc.
    #[must_use]
    pub fn moved(self, twist: Twist, seconds: f64) -> Self {
        self.displaced(twist.linear * seconds, twist.angular * seconds)
    }

    /// Returns the pose at which a body arrives that covers `distance`, m, while it turns by
    /// `turn`, rad, counter-clockwise. The path is a circular arc, straight when `turn` is 0.
    ///
    /// ```
    /// use core::f64::consts::PI;
    /// use tolman_geom::{Heading, Point, Pose};
    ///
    /// let start = Pose::new(Point::new(1.0, 0.0), Heading::NORTH);
    /// let straight = start.displaced(2.0, 0.0);
    /// assert!((straight.position - Point::new(1.0, 2.0)).norm() < 1e-12);
    /// // Half a circle to the left, of circumference 2π: one step back west, two over.
    /// let half = start.displaced(PI, PI);
    /// assert!((half.position - Point::new(-1.0, 0.0)).norm() < 1e-12);
    /// ```
    #[must_use]
    pub fn displaced(self, distance: f64, turn: f64) -> Self {
        // The chord of the arc leaves at half the turn; its length is sinc(turn / 2) of the path.
        let chord = distance * sinc(0.5 * turn);
        Self::new(
            self.position + self.heading.turned(0.5 * turn).unit() * chord,
            self.heading.turned(turn),
        )
    }

    /// Returns whether position and heading are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.position.x.is_finite() && self.position.y.is_finite() && self.heading.is_finite()
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl From<Pose> for Isometry2<f64> {
    fn from(pose: Pose) -> Self {
        let unit = pose.heading.unit();
        Self::from_parts(
            pose.position.coords.into(),
            UnitComplex::from_cos_sin_unchecked(unit.x, unit.y),
        )
    }
}

impl From<Isometry2<f64>> for Pose {
    fn from(isometry: Isometry2<f64>) -> Self {
        Self::new(
            isometry.translation.vector.into(),
            Heading::of(Vector::new(isometry.rotation.re, isometry.rotation.im)),
        )
    }
}

/// Returns sin(x)/x, by its series if the quotient would lose digits.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 {
        let square = x * x;
        1.0 - square / 6.0 + square * square / 120.0
    } else {
        libm::sin(x) / x
    }
}

/// Returns the length of a path, m: the sum of the distances between poses that follow each other.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose, path_length};
///
/// let path = [0.0, 3.0, 1.0].map(|x| Pose::new(Point::new(x, 0.0), Heading::EAST));
/// assert_eq!(path_length(&path), 5.0);
/// ```
#[must_use]
pub fn path_length(path: &[Pose]) -> f64 {
    let steps = path.windows(2);
    steps
        .map(|step| (step[1].position - step[0].position).norm())
        .sum()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn pose() -> impl Strategy<Value = Pose> {
        (-50.0..50.0, -50.0..50.0, -4.0..4.0)
            .prop_map(|(x, y, h)| Pose::new(Point::new(x, y), Heading::from_radians(h)))
    }

    fn same(a: Pose, b: Pose) -> bool {
        (a.position - b.position).norm() < 1e-9 && a.heading.turn_to(b.heading).abs() < 1e-9
    }

    proptest! {
        #[test]
        fn a_pose_and_its_inverse_cancel(a in pose()) {
            prop_assert!(same(a.compose(a.inverse()), Pose::IDENTITY));
            prop_assert!(same(a.inverse().compose(a), Pose::IDENTITY));
        }

        #[test]
        fn composition_is_associative(a in pose(), b in pose(), c in pose()) {
            prop_assert!(same(a.compose(b).compose(c), a.compose(b.compose(c))));
        }

        #[test]
        fn between_undoes_compose(a in pose(), b in pose()) {
            prop_assert!(same(a.between(a.compose(b)), b));
        }

        #[test]
        fn composition_agrees_with_nalgebra(a in pose(), b in pose()) {
            let theirs: Isometry2<f64> = Isometry2::from(a) * Isometry2::from(b);
            prop_assert!(same(a.compose(b), theirs.into()));
        }

        #[test]
        fn an_arc_is_the_limit_of_many_short_arcs(a in pose(), distance in -2.0_f64..2.0, turn in -3.0_f64..3.0) {
            let mut walked = a;
            for _ in 0..64 {
                walked = walked.displaced(distance / 64.0, turn / 64.0);
            }
            prop_assert!(same(walked, a.displaced(distance, turn)));
        }

        #[test]
        fn a_twist_that_is_kept_covers_its_speeds_by_the_time(a in pose(), linear in -2.0_f64..2.0, angular in -2.0_f64..2.0, seconds in 0.1_f64..3.0) {
            let moved = a.moved(Twist { linear, angular }, seconds);
            prop_assert!(same(moved, a.displaced(linear * seconds, angular * seconds)));
        }

        #[test]
        fn moving_back_returns(a in pose(), linear in -2.0_f64..2.0, angular in -2.0_f64..2.0) {
            let twist = Twist::new(linear, angular);
            prop_assert!(same(a.moved(twist, 0.7).moved(twist, -0.7), a));
        }
    }

    #[test]
    fn the_series_meets_the_quotient() {
        for x in [0.999e-4, -0.999e-4, 1.001e-4] {
            assert!((sinc(x) - libm::sin(x) / x).abs() < 1e-15, "{x}");
        }
        assert!((sinc(0.0) - 1.0).abs() < f64::EPSILON);
    }

    #[test]
    fn nan_and_infinities_stay_visible() {
        let at = |x, y, heading| Pose::new(Point::new(x, y), Heading::from_radians(heading));
        assert!(at(1.0, 2.0, 3.0).is_finite());
        assert!(!at(f64::NAN, 2.0, 3.0).is_finite());
        assert!(!at(1.0, f64::INFINITY, 3.0).is_finite());
        assert!(!at(1.0, 2.0, f64::NAN).is_finite());
        assert!(!at(1.0, 2.0, 3.0).displaced(f64::NAN, 0.0).is_finite());
    }

    /// Traces hold these, so the names must last, and no bit of a number may be lost.
    #[cfg(feature = "serde")]
    #[test]
    fn poses_survive_json() {
        let pose = Pose::new(
            Point::new(0.1 + 0.2, -1e-300),
            Heading::from_radians(-1.0 / 3.0),
        );
        let json = serde_json::to_string(&pose).unwrap();
        assert_eq!(
            json,
            r#"{"position":[0.30000000000000004,-1e-300],"heading":-0.3333333333333333}"#
        );
        assert_eq!(serde_json::from_str::<Pose>(&json).unwrap(), pose);

        let beyond = r#"{"position":[0.0,0.0],"heading":7.0}"#;
        let wrapped = serde_json::from_str::<Pose>(beyond).unwrap().heading;
        assert_eq!(
            wrapped,
            Heading::from_radians(7.0),
            "a heading read is wrapped"
        );
        let null = r#"{"position":[0.0,0.0],"heading":null}"#;
        assert!(
            serde_json::from_str::<Pose>(null).is_err(),
            "what JSON makes of NaN"
        );
    }
}
