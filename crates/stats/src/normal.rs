//! The standard normal distribution, far into its tails.

use core::f64::consts::{FRAC_1_SQRT_2, LN_2, PI};

/// Returns Φ(z), the probability of a value below `z`.
pub(super) fn cumulative(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Returns ln(1 − Φ(z)), finite for every finite `z`, also where 1 − Φ(z) itself underflows (z >
/// 38).
pub(super) fn ln_upper_tail(z: f64) -> f64 {
    // From here on six terms of the asymptotic series (Abramowitz and Stegun 26.2.12) are exact to
    // the last bits. erfc is still far from underflow.
    const FAR: f64 = 30.0;
    if z < 0.0 {
        return libm::log1p(-cumulative(z));
    }
    if z < FAR {
        return libm::log(libm::erfc(z * FRAC_1_SQRT_2)) - LN_2;
    }
    let inverse_square = 1.0 / (z * z);
    // 1 − 1/z² + 3/z⁴ − 15/z⁶ + …, by Horner.
    let series = [11.0, 9.0, 7.0, 5.0, 3.0, 1.0]
        .into_iter()
        .fold(1.0, |series, odd| 1.0 - odd * inverse_square * series);
    -0.5 * z * z - libm::log(z * (2.0 * PI).sqrt()) + libm::log(series)
}

/// Returns the `z` with Φ(z) = `probability`, for probabilities strictly between 0 and 1.
///
/// Newton's method on the logarithm of the tail: that function is concave, so from the second step
/// on the iteration falls monotonically onto the root.
pub(super) fn quantile(probability: f64) -> f64 {
    let (tail, sign) = if probability < 0.5 {
        (probability, -1.0)
    } else {
        (1.0 - probability, 1.0)
    };
    let target = libm::log(tail);
    let mut z = 0.0;
    for _ in 0..60 {
        let ln_tail = ln_upper_tail(z);
        // d/dz ln(1 − Φ) = −φ / (1 − Φ).
        let hazard = libm::exp(-0.5 * z * z - 0.5 * libm::log(2.0 * PI) - ln_tail);
        let step = (ln_tail - target) / hazard;
        z += step;
        if step.abs() <= 1e-15 * z.abs() {
            break;
        }
    }
    sign * z
}
