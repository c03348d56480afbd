//! Sine and cosine of intervals, without a libm, whose rounding errors are unknown.
//!
//! An angle is reduced to near 0 by a multiple of π/2 that is itself an interval. The Taylor series
//! is summed in interval arithmetic, and its remainder is added.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::Interval;
use crate::floor_index;

/// π/2 in three parts (Cody and Waite). Multiples of the first are exact, since its last 22 bits
/// are 0; what is left of π/2 behind the second lies within the third.
const HALF_PI: [Interval; 3] = [
    Interval::point(f64::from_bits(0x3FF9_21FB_5440_0000)),
    Interval::point(f64::from_bits(0x3DD0_B461_1A62_6331)),
    Interval::from_bounds(3.521e-27, 3.522e-27),
];

/// Number of quarter turns beyond which angles are not distinguished.
const MOST_QUARTERS: f64 = 1_048_576.0;

/// Bounds of the remainder of the series after x¹⁷ (x¹⁸ for the cosine) for |x| ≤ 0.8: 0.8¹⁹ / 19!.
const REMAINDER: Interval = Interval::from_bounds(-1.2e-19, 1.2e-19);

impl Interval {
    /// Returns the sines of all angles here, in radians: exact up to a few units in the last place,
    /// also where an extreme lies inside.
    #[must_use]
    pub fn sin(self) -> Self {
        self.sines().0
    }

    /// Returns the cosines of all angles here, in radians.
    #[must_use]
    pub fn cos(self) -> Self {
        self.sines().1
    }

    /// Returns an interval that contains 2π.
    pub(crate) fn full_circle() -> Self {
        multiple_of_half_pi(4)
    }

    /// Returns the sines and the cosines of all angles in the interval, in radians.
    pub(crate) fn sines(self) -> (Self, Self) {
        // Sine and cosine of the multiples of half π.
        const EXTREMES: [(f64, f64); 4] = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        const ALL: Interval = Interval::from_bounds(-1.0, 1.0);
        let reach = MOST_QUARTERS * FRAC_PI_2;
        if self.width() >= TAU || self.low < -reach || self.high > reach {
            return (ALL, ALL);
        }
        let (mut sin, mut cos) = sines_of(self.low);
        if self.low < self.high {
            let (high_sin, high_cos) = sines_of(self.high);
            (sin, cos) = (sin.hull(high_sin), cos.hull(high_cos));
        }
        // Between the ends both are monotonic, except at the quarter turns inside. The quotients
        // are rounded, so one more is tried.
        let [first, last] = [self.low, self.high].map(|end| floor_index(end / FRAC_PI_2));
        for quarter in first..=last + 1 {
            if multiple_of_half_pi(quarter).meets(self) {
                let (of_sin, of_cos) = EXTREMES[quarter.rem_euclid(4) as usize];
                sin = sin.hull(Interval::point(of_sin));
                cos = cos.hull(Interval::point(of_cos));
            }
        }
        let within = |values: Self| Self::from_bounds(values.low.max(-1.0), values.high.min(1.0));
        (within(sin), within(cos))
    }
}

fn multiple_of_half_pi(quarters: i32) -> Interval {
    let quarters = Interval::point(f64::from(quarters));
    let [first, second, rest] = HALF_PI;
    quarters * rest + quarters * second + exact_product(quarters, first)
}

/// Returns the product of a whole number of at most 20 bits with a number whose last 22 bits are 0.
fn exact_product(whole: Interval, short: Interval) -> Interval {
    Interval::point(whole.low * short.low)
}

/// Returns sine and cosine of one angle of at most [`MOST_QUARTERS`].
fn sines_of(angle: f64) -> (Interval, Interval) {
    let quarters = libm::round(angle / FRAC_PI_2);
    let [first, second, rest] = HALF_PI;
    let count = Interval::point(quarters);
    let near_zero =
        Interval::point(angle) - exact_product(count, first) - count * second - count * rest;
    let (sin, cos) = series(near_zero);
    match (quarters as i32).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Returns sine and cosine of an angle within 0.8 rad of 0, by their series in Horner's form. The
/// series are sin x = x (1 − x²/(2·3) (1 − x²/(4·5) (…))) and cos x = 1 − x²/(1·2) (1 − x²/(3·4)
/// (…)).
fn series(x: Interval) -> (Interval, Interval) {
    const ONE: Interval = Interval::point(1.0);
    let square = x.squared();
    let horner = |last: u32| {
        (2..=last).rev().step_by(2).fold(ONE, |sum, n| {
            let divisor = Interval::point(f64::from(n * (n - 1)));
            // No divisor is 0.
            ONE - (square * sum).checked_div(divisor).unwrap_or(square)
        })
    };
    (x * horner(17) + REMAINDER, horner(18) + REMAINDER)
}
