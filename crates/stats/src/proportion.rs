//! Confidence intervals of a success rate.

use super::beta::regularized_incomplete_beta;
use super::error::check_probability;
use super::{ConfidenceInterval, SampleError, normal};

/// Returns Wilson's score interval of a success rate, between 0 and 1. Source: "Probable inference,
/// the law of succession, and statistical inference" (1927).
///
/// # Errors
/// If there are no trials, more successes than trials, or the level is not a probability.
pub fn wilson_interval(
    successes: u64,
    trials: u64,
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    let (k, n) = check(successes, trials, level)?;
    let z = normal::quantile(f64::midpoint(1.0, level).min(1.0 - 1e-16));
    let (rate, z2) = (k / n, z * z);
    let centre = rate + z2 / (2.0 * n);
    let half = z * (rate * (1.0 - rate) / n + z2 / (4.0 * n * n)).sqrt();
    let shrink = 1.0 + z2 / n;
    Ok(ConfidenceInterval::new(
        ((centre - half) / shrink).max(0.0),
        ((centre + half) / shrink).min(1.0),
    ))
}

/// Returns the exact binomial interval of a success rate, between 0 and 1. Source: Clopper and
/// Pearson, "The use of confidence or fiducial limits illustrated in the case of the binomial"
/// (1934).
///
/// ```
/// use tolman_stats::exact_binomial_interval;
///
/// // 17 of 25: between 46 % and 85 %.
/// let interval = exact_binomial_interval(17, 25, 0.95)?;
/// assert!((interval.low - 0.465).abs() < 1e-3 && (interval.high - 0.851).abs() < 1e-3);
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If there are no trials, more successes than trials, or the level is not a probability.
pub fn exact_binomial_interval(
    successes: u64,
    trials: u64,
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    let (k, n) = check(successes, trials, level)?;
    let tail = (1.0 - level) / 2.0;
    let low = match successes {
        0 => 0.0,
        _ => solve(|rate| regularized_incomplete_beta(k, n - k + 1.0, rate) - tail),
    };
    let high = match trials - successes {
        0 => 1.0,
        _ => solve(|rate| regularized_incomplete_beta(k + 1.0, n - k, rate) - (1.0 - tail)),
    };
    Ok(ConfidenceInterval::new(low, high))
}

fn check(successes: u64, trials: u64, level: f64) -> Result<(f64, f64), SampleError> {
    if trials == 0 {
        return Err(SampleError::TooSmall {
            count: 0,
            needed: 1,
        });
    }
    if successes > trials {
        return Err(SampleError::Successes { successes, trials });
    }
    check_probability(level)?;
    Ok((successes as f64, trials as f64))
}

/// Returns the zero of an increasing function between 0 and 1, by bisection to the last bit.
fn solve(function: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return middle;
        }
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}
