use core::f64::consts::TAU;

use crate::{Interval, IntervalError, PointBox, Pose};

/// A pose known to lie within bounds, and so a rigid transform known within bounds: the uncertain
/// [`Pose`].
///
/// The heading is not wrapped and may be wider than a full circle. Headings a full circle apart are
/// the same wherever poses are compared. All operations are sound: whatever true poses lie in the
/// operands, the true result lies in the result.
///
/// ```
/// use tolman_geom::{Heading, Interval, Point, PointBox, Pose, PoseBox};
///
/// // A metre ahead give or take 10 cm, then to the left by 90° give or take 1°; four times: round a square.
/// let leg = PoseBox::new(
///     PointBox::new(Interval::about(1.0, 0.1)?, Interval::ZERO),
///     Interval::about(90_f64.to_radians(), 1_f64.to_radians())?,
/// );
/// let round = (1..4).fold(leg, |way, _| way.compose(leg));
/// assert!(round.contains(Pose::IDENTITY));
/// assert!(round.position.width() < 0.8);
/// // Somebody recognizes the start: two estimates of the same pose narrow each other.
/// let seen = PoseBox::about(Pose::IDENTITY, 0.05, 0.02)?;
/// let both = round.intersection(seen).unwrap();
/// assert!(seen.position.encloses(both.position));
/// # Ok::<(), tolman_geom::IntervalError>(())
/// ```
///
/// Source: Engelson and McDermott, *Maps considered as adaptive planning resources*: positions and
/// headings as intervals, composed and inverted along links.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseBox {
    /// Bounds of the position, m.
    pub position: PointBox,
    /// Bounds of the heading, rad, not wrapped.
    pub heading: Interval,
}

impl PoseBox {
    /// The origin, looking east, for certain.
    pub const IDENTITY: Self = Self::new(PointBox::ORIGIN, Interval::ZERO);

    /// Returns a box from its parts.
    #[must_use]
    #[inline]
    pub const fn new(position: PointBox, heading: Interval) -> Self {
        Self { position, heading }
    }

    /// Returns the box that holds only `pose`.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn of(pose: Pose) -> Result<Self, IntervalError> {
        Self::about(pose, 0.0, 0.0)
    }

    /// Returns all poses within `metres` of `middle` along each axis and within `radians` of its
    /// heading.
    ///
    /// # Errors
    /// If a margin is negative or something is not a number.
    pub fn about(middle: Pose, metres: f64, radians: f64) -> Result<Self, IntervalError> {
        Ok(Self::new(
            PointBox::about(middle.position, metres)?,
            Interval::about(middle.heading.radians(), radians)?,
        ))
    }

    /// Returns `a_from_c` for `a_from_b.compose(b_from_c)`.
    #[must_use]
    pub fn compose(self, inner: Self) -> Self {
        Self::new(self.transform(inner.position), self.heading + inner.heading)
    }

    /// Returns `b_from_a` for `a_from_b.inverse()`.
    #[must_use]
    pub fn inverse(self) -> Self {
        Self::new((-self.position).rotated(-self.heading), -self.heading)
    }

    /// Returns `other` relative to this pose: `a_from_b` for `world_from_a.between(world_from_b)`.
    /// It is narrower than composing with the inverse, which ignores that position and heading are
    /// relative to the same place.
    #[must_use]
    pub fn between(self, other: Self) -> Self {
        Self::new(
            (other.position - self.position).rotated(-self.heading),
            other.heading - self.heading,
        )
    }

    /// Returns the box of `position`, given in this pose's own frame, in the frame in which the
    /// pose is given.
    #[must_use]
    pub fn transform(self, position: PointBox) -> PointBox {
        self.position + position.rotated(self.heading)
    }

    /// Returns whether a pose lies inside, its heading up to full circles.
    #[must_use]
    pub fn contains(self, pose: Pose) -> bool {
        let heading = Interval::of(pose.heading.radians());
        self.position.contains(pose.position)
            && heading.is_ok_and(|heading| self.heading.meets(nearest(heading, self.heading)))
    }

    /// Returns the box of all poses that both allow, with headings up to full circles. `None` if
    /// they contradict each other: then a bound was broken, or the two are not estimates of the
    /// same pose. If wide headings agree in two parts of the circle, the result also includes the
    /// part between them.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        Some(Self::new(
            self.position.intersection(other.position)?,
            common(self.heading, other.heading)?,
        ))
    }

    /// Returns the least box that holds both, the headings of `other` brought to within half a
    /// circle of those here.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self::new(
            self.position.hull(other.position),
            self.heading.hull(nearest(other.heading, self.heading)),
        )
    }

    /// Returns a pose in the middle, always inside.
    #[must_use]
    pub fn middle(self) -> Pose {
        Pose::new(self.position.middle(), self.heading.middle().into())
    }
}

/// Returns the angles of `a` that are, up to full circles, in `b`.
fn common(a: Interval, b: Interval) -> Option<Interval> {
    if a.width() >= TAU {
        return Some(b);
    }
    if b.width() >= TAU {
        return Some(a);
    }
    let circle = Interval::full_circle();
    let b = nearest(b, a);
    let parts = [b - circle, b, b + circle].map(|turned| a.intersection(turned));
    parts.into_iter().flatten().reduce(Interval::hull)
}

/// Returns `angles` turned by whole circles such that their middle is nearest to that of `target`.
fn nearest(angles: Interval, target: Interval) -> Interval {
    let circles = libm::round((target.middle() - angles.middle()) / TAU);
    if circles == 0.0 {
        return angles;
    }
    angles + Interval::full_circle() * Interval::point(circles)
}
