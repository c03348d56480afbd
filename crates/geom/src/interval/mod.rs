//! Numbers known to lie between two bounds.

mod arithmetic;
mod error;
mod rounding;
mod trigonometry;

use core::fmt;

pub use error::IntervalError;
use rounding::{sum_down, sum_up};

/// A closed interval of reals, never empty, whose bounds are known for certain: `low` ≤ `high`. An
/// infinite bound means that the number is unbounded on that side.
///
/// Arithmetic is *sound*: if x lies in `a` and y in `b`, then x + y lies in `a + b`, whatever was
/// rounded on the way. Bounds that are not exact are rounded outwards. It is *monotone*: narrower
/// operands give no wider result (sine and cosine up to their last digits). A result that does not
/// exist is `None`: the intersection of disjoint intervals, or the root of a negative number.
///
/// ```
/// use tolman_geom::Interval;
///
/// let wheel = Interval::about(1.0, 0.1)?; // a metre, give or take 10 cm
/// let twice = wheel + wheel;
/// assert!(twice.contains(1.8) && twice.contains(2.2));
/// // Seen from elsewhere it is at least 2.1 m.
/// let seen = Interval::new(2.1, 3.0)?;
/// let both = twice.intersection(seen).unwrap();
/// assert!(both.width() < 0.11);
/// assert!(twice.intersection(Interval::new(5.0, 6.0)?).is_none());
/// # Ok::<(), tolman_geom::IntervalError>(())
/// ```
///
/// Source: the diktiometry of Engelson and McDermott keeps every position and heading as such an
/// interval.
#[derive(Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Bounds", into = "Bounds"))]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// The interval that holds only 0.
    pub const ZERO: Self = Self::from_bounds(0.0, 0.0);

    /// The interval of all numbers: nothing is known.
    pub const UNBOUNDED: Self = Self::from_bounds(f64::NEG_INFINITY, f64::INFINITY);

    /// Returns the interval from `low` to `high`.
    ///
    /// # Errors
    /// If a bound is NaN, `low` is above `high`, or no finite number lies between them.
    pub fn new(low: f64, high: f64) -> Result<Self, IntervalError> {
        if low.is_nan() || high.is_nan() {
            return Err(IntervalError::NotANumber { low, high });
        }
        if low > high || low == f64::INFINITY || high == f64::NEG_INFINITY {
            return Err(IntervalError::Empty { low, high });
        }
        Ok(Self { low, high })
    }

    /// Returns one number.
    ///
    /// # Errors
    /// If it is NaN or infinite.
    pub fn of(value: f64) -> Result<Self, IntervalError> {
        Self::new(value, value)
    }

    /// Returns the interval of all numbers within `margin` of `middle`.
    ///
    /// # Errors
    /// If `margin` is negative or one of them is not a number.
    pub fn about(middle: f64, margin: f64) -> Result<Self, IntervalError> {
        if margin < 0.0 {
            return Err(IntervalError::NegativeMargin { margin });
        }
        Ok(Self::of(middle)? + Self::new(-margin, margin)?)
    }

    /// Returns the interval from `low` to `high`, which are known to be bounds.
    #[inline]
    const fn from_bounds(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// Returns the interval that holds only one number, which is known to be finite.
    pub(crate) const fn point(value: f64) -> Self {
        Self::from_bounds(value, value)
    }

    /// Returns the lower and the upper half of the interval.
    pub(crate) fn halves(self) -> (Self, Self) {
        let middle = self.middle();
        (
            Self::from_bounds(self.low, middle),
            Self::from_bounds(middle, self.high),
        )
    }

    /// Returns the least value that the number may have.
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Returns the greatest value that the number may have.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// Returns an upper bound of `high − low`; infinite if a bound is missing.
    #[must_use]
    #[inline]
    pub fn width(self) -> f64 {
        sum_up(self.high, -self.low)
    }

    /// Returns a number in the middle, always inside; 0 or the one bound if the other is missing.
    #[must_use]
    pub fn middle(self) -> f64 {
        match (self.low.is_finite(), self.high.is_finite()) {
            // Halved first, so that the sum cannot overflow.
            (true, true) => (0.5 * self.low + 0.5 * self.high).clamp(self.low, self.high),
            (true, false) => self.low,
            (false, true) => self.high,
            (false, false) => 0.0,
        }
    }

    /// Returns whether both bounds are finite.
    #[must_use]
    pub const fn is_bounded(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Returns whether `value` lies inside; never NaN.
    #[must_use]
    #[inline]
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Returns whether all of `other` lies inside.
    #[must_use]
    pub fn encloses(self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }

    /// Returns whether the two have a number in common.
    #[must_use]
    #[inline]
    pub fn meets(self, other: Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Returns a lower bound of the distance between a number of each; 0 if they meet.
    #[must_use]
    pub fn gap(self, other: Self) -> f64 {
        sum_down(self.low, -other.high)
            .max(sum_down(other.low, -self.high))
            .max(0.0)
    }

    /// Returns the interval of all numbers that both allow, or `None` if they contradict each
    /// other.
    #[must_use]
    #[inline]
    pub fn intersection(self, other: Self) -> Option<Self> {
        self.meets(other)
            .then(|| Self::from_bounds(self.low.max(other.low), self.high.min(other.high)))
    }

    /// Returns the least interval that holds both.
    #[must_use]
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Self::from_bounds(self.low.min(other.low), self.high.max(other.high))
    }
}

impl fmt::Debug for Interval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "[{:?}, {:?}]", self.low, self.high)
    }
}

impl fmt::Display for Interval {
    /// Writes `[low, high]`, with the decimals asked for.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { low, high } = self;
        match out.precision() {
            Some(decimals) => write!(out, "[{low:.decimals$}, {high:.decimals$}]"),
            None => write!(out, "[{low}, {high}]"),
        }
    }
}

/// Form in which intervals are written: `[low, high]`, with `null` for an infinite bound, as JSON
/// has no infinity.
#[cfg(feature = "serde")]
type Bounds = [Option<f64>; 2];

#[cfg(feature = "serde")]
impl From<Interval> for Bounds {
    fn from(interval: Interval) -> Self {
        [interval.low, interval.high].map(|bound| Some(bound).filter(|b| b.is_finite()))
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Bounds> for Interval {
    type Error = IntervalError;

    fn try_from([low, high]: Bounds) -> Result<Self, IntervalError> {
        Self::new(
            low.unwrap_or(f64::NEG_INFINITY),
            high.unwrap_or(f64::INFINITY),
        )
    }
}
