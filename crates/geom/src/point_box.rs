use crate::{Interval, IntervalError, Point};

/// A position known to lie in a rectangle along the axes; or a displacement, which is a position
/// seen from another.
///
/// Never empty. All operations are sound and monotone, as those of [`Interval`] are.
///
/// ```
/// use tolman_geom::{Interval, Point, PointBox};
///
/// let corner = PointBox::about(Point::new(2.0, 0.0), 0.1)?;
/// // Turned by a right angle, give or take a degree.
/// let turn = Interval::about(90_f64.to_radians(), 1_f64.to_radians())?;
/// let turned = corner.rotated(turn);
/// assert!(turned.contains(Point::new(0.0, 2.0)));
/// assert!(turned.x.width() < 0.3 && turned.y.width() < 0.21);
/// # Ok::<(), tolman_geom::IntervalError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointBox {
    /// Bounds from west to east, m.
    pub x: Interval,
    /// Bounds from south to north, m.
    pub y: Interval,
}

impl PointBox {
    /// The origin alone.
    pub const ORIGIN: Self = Self::new(Interval::ZERO, Interval::ZERO);

    /// The whole plane: nothing is known.
    pub const UNBOUNDED: Self = Self::new(Interval::UNBOUNDED, Interval::UNBOUNDED);

    /// Returns a box from its sides.
    #[must_use]
    #[inline]
    pub const fn new(x: Interval, y: Interval) -> Self {
        Self { x, y }
    }

    /// Returns the box that holds only `point`.
    ///
    /// # Errors
    /// If it is not finite.
    pub fn of(point: Point) -> Result<Self, IntervalError> {
        Ok(Self::new(Interval::of(point.x)?, Interval::of(point.y)?))
    }

    /// Returns the box of all positions within `margin` of `middle` along each axis.
    ///
    /// # Errors
    /// If `margin` is negative or something is not a number.
    pub fn about(middle: Point, margin: f64) -> Result<Self, IntervalError> {
        Ok(Self::new(
            Interval::about(middle.x, margin)?,
            Interval::about(middle.y, margin)?,
        ))
    }

    /// Returns a position in the middle, always inside.
    #[must_use]
    pub fn middle(self) -> Point {
        Point::new(self.x.middle(), self.y.middle())
    }

    /// Returns the longer side, m.
    #[must_use]
    #[inline]
    pub fn width(self) -> f64 {
        self.x.width().max(self.y.width())
    }

    /// Returns whether all four bounds are finite.
    #[must_use]
    pub const fn is_bounded(self) -> bool {
        self.x.is_bounded() && self.y.is_bounded()
    }

    /// Returns whether a position lies inside; never one with NaN.
    #[must_use]
    #[inline]
    pub fn contains(self, point: Point) -> bool {
        self.x.contains(point.x) && self.y.contains(point.y)
    }

    /// Returns whether all of `other` lies inside.
    #[must_use]
    pub fn encloses(self, other: Self) -> bool {
        self.x.encloses(other.x) && self.y.encloses(other.y)
    }

    /// Returns whether the two have a position in common.
    #[must_use]
    #[inline]
    pub fn meets(self, other: Self) -> bool {
        self.x.meets(other.x) && self.y.meets(other.y)
    }

    /// Returns the box of all points that both allow, or `None` if they contradict each other.
    #[must_use]
    #[inline]
    pub fn intersection(self, other: Self) -> Option<Self> {
        Some(Self::new(
            self.x.intersection(other.x)?,
            self.y.intersection(other.y)?,
        ))
    }

    /// Returns the least box that holds both.
    #[must_use]
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Self::new(self.x.hull(other.x), self.y.hull(other.y))
    }

    /// Returns the bounds of the distance from the origin, m: how long the displacement may be.
    #[must_use]
    pub fn norm(self) -> Interval {
        let square = self.x.squared() + self.y.squared();
        // A sum of squares is never negative.
        square.sqrt().unwrap_or(Interval::ZERO)
    }

    /// Returns all distances between a position of each, m.
    #[must_use]
    pub fn distance(self, other: Self) -> Interval {
        (self - other).norm()
    }

    /// Returns the box of the positions turned about the origin by any of `angles`, rad. It is the
    /// smallest such box up to rounding.
    ///
    /// For a given angle the turned position depends linearly on the position, so it is extreme in
    /// a corner. As the angle grows, a corner follows a circle about the origin, whose extremes lie
    /// at the ends or where it crosses an axis. (Cosine and sine each as an interval of its own
    /// would be sound, but wider.)
    #[must_use]
    pub fn rotated(self, angles: Interval) -> Self {
        /// Nearly a full circle, on which all extremes lie.
        const WHOLE: f64 = 6.25;
        /// Angle of a part, rad: less than half a circle, on which a corner's shadow has at most
        /// one extreme.
        const PART: f64 = 2.0;
        if angles.width() >= WHOLE || !self.is_bounded() {
            let longest = self.norm();
            let all = longest.hull(-longest);
            return Self::new(all, all);
        }
        if angles.width() > PART {
            let (first, second) = angles.halves();
            return self.rotated(first).hull(self.rotated(second));
        }
        let ends = [angles.low(), angles.high()].map(|end| Interval::point(end).sines());
        Self::new(
            shadow(self.x, self.y, &ends),
            shadow(self.y, -self.x, &ends),
        )
    }
}

/// Sine and cosine of both ends of an interval of angles.
type Ends = [(Interval, Interval); 2];

/// Returns all values of a · cos θ − b · sin θ, for angles over less than half a circle.
fn shadow(a: Interval, b: Interval, ends: &Ends) -> Interval {
    let corners = [a.low(), a.high()].map(|a| [b.low(), b.high()].map(|b| trace(a, b, ends)));
    let [[first, second], [third, fourth]] = corners;
    first.hull(second).hull(third.hull(fourth))
}

/// Returns the shadow of one corner.
fn trace(a: f64, b: f64, ends: &Ends) -> Interval {
    let (a, b) = (Interval::point(a), Interval::point(b));
    let ends = ends.map(|(sin, cos)| {
        let value = a * cos - b * sin;
        let slope = -(a * sin) - b * cos;
        (value, slope)
    });
    let [(first, before), (second, after)] = ends;
    let hull = first.hull(second);
    // Over less than half a circle there is an extreme between the ends only where the slope
    // changes sign. Where a slope's sign is not certain, an end is an extreme up to rounding.
    let longest = || PointBox::new(a, b).norm();
    let rises_then_falls = before.high() >= 0.0 && after.low() <= 0.0;
    let falls_then_rises = before.low() <= 0.0 && after.high() >= 0.0;
    match (rises_then_falls, falls_then_rises) {
        (true, false) => hull.hull(longest()),
        (false, true) => hull.hull(-longest()),
        (true, true) if hull.low() >= 0.0 => hull.hull(longest()),
        (true, true) if hull.high() <= 0.0 => hull.hull(-longest()),
        (true, true) => hull.hull(longest()).hull(-longest()),
        (false, false) => hull,
    }
}

impl core::ops::Neg for PointBox {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl core::ops::Add for PointBox {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl core::ops::Sub for PointBox {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}
