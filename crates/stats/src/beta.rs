//! The incomplete beta function.

/// Returns Iₓ(a, b), the cumulative beta distribution, for positive `a` and `b` and `x` from 0
/// to 1.
///
/// The continued fraction of DLMF 8.17.22 by Lentz's algorithm, on the side where it converges
/// fast.
pub(super) fn regularized_incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - regularized_incomplete_beta(b, a, 1.0 - x);
    }
    let ln_front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b)
        + a * libm::log(x)
        + b * libm::log1p(-x);
    libm::exp(ln_front) / (a * continued_fraction(a, b, x))
}

/// Returns 1 + d₁/(1 + d₂/(1 + …)).
fn continued_fraction(a: f64, b: f64, x: f64) -> f64 {
    /// Denominator in place of zero.
    const TINY: f64 = 1e-300;
    let not_zero = |value: f64| if value.abs() < TINY { TINY } else { value };
    let (mut fraction, mut upper, mut lower) = (1.0, 1.0, 0.0);
    for term in 1..2000_u32 {
        let m = f64::from(term / 2);
        let coefficient = if term % 2 == 0 {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        } else {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        };
        lower = 1.0 / not_zero(1.0 + coefficient * lower);
        upper = not_zero(1.0 + coefficient / upper);
        let factor = upper * lower;
        fraction *= factor;
        if (factor - 1.0).abs() < 1e-16 {
            break;
        }
    }
    fraction
}
