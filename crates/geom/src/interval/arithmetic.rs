//! + − × ÷, squares and roots.

use core::ops::{Add, Mul, Neg, Sub};

use super::rounding::{
    product_down, product_up, quotient_down, quotient_up, root, sum_down, sum_up,
};
use super::{Interval, IntervalError};

impl Interval {
    /// Returns the interval of all quotients of a number in `self` and a number other than 0 in
    /// `divisor`. `None` if the divisor is 0 alone. If 0 is inside or at the end of the divisor,
    /// the quotient may be unbounded.
    #[must_use]
    pub fn checked_div(self, divisor: Self) -> Option<Self> {
        let Self { low, high } = divisor;
        if low < 0.0 && high > 0.0 {
            return Some(Self::UNBOUNDED);
        }
        if high <= 0.0 {
            let mirrored = (low < 0.0).then(|| (-self).checked_div(-divisor));
            return mirrored.flatten();
        }
        // The divisor is positive, except that its lower bound may be 0.
        let over = |numerator: f64, quotient: fn(f64, f64) -> f64, [below, above]: [f64; 2]| {
            // The larger quotient is over the smaller divisor where the numerator is positive.
            let divisor = if numerator < 0.0 { below } else { above };
            if divisor == 0.0 && numerator != 0.0 {
                numerator.signum() * f64::INFINITY
            } else if divisor == 0.0 {
                0.0
            } else {
                quotient(numerator, divisor)
            }
        };
        Some(Self::from_bounds(
            over(self.low, quotient_down, [low, high]),
            over(self.high, quotient_up, [high, low]),
        ))
    }

    /// Returns the interval of all squares. It is narrower than the product of the interval with
    /// itself if 0 lies inside.
    #[must_use]
    pub fn squared(self) -> Self {
        let Self { low, high } = self.abs();
        Self::from_bounds(product_down(low, low).max(0.0), product_up(high, high))
    }

    /// Returns the interval of the square roots of all numbers ≥ 0 in it, or `None` if all are
    /// negative.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        (self.high >= 0.0).then(|| {
            Self::from_bounds(
                root(self.low.max(0.0), f64::next_down),
                root(self.high, f64::next_up),
            )
        })
    }

    /// Returns the interval of all absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self::from_bounds(0.0, self.high.max(-self.low))
        }
    }

    /// Returns the interval widened by `margin` at both ends.
    ///
    /// # Errors
    /// If `margin` is negative or not a number.
    pub fn widened(self, margin: f64) -> Result<Self, IntervalError> {
        Ok(self + Self::about(0.0, margin)?)
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::from_bounds(-self.high, -self.low)
    }
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::from_bounds(sum_down(self.low, other.low), sum_up(self.high, other.high))
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let corners = [
            (self.low, other.low),
            (self.low, other.high),
            (self.high, other.low),
            (self.high, other.high),
        ];
        let low = corners.map(|(a, b)| product_down(a, b));
        let high = corners.map(|(a, b)| product_up(a, b));
        Self::from_bounds(
            low.into_iter().fold(f64::INFINITY, f64::min),
            high.into_iter().fold(f64::NEG_INFINITY, f64::max),
        )
    }
}
