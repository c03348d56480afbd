//! Confidence intervals of the difference of two samples, of which one may be known by its summary
//! alone.

use super::beta::regularized_incomplete_beta;
use super::error::check_probability;
use super::{ConfidenceInterval, SampleError, wilson_interval};

/// A sample described by its size, mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleSummary {
    /// Number of values.
    pub count: u64,
    /// Mean of the values.
    pub mean: f64,
    /// Standard deviation of the values, with n − 1 in the denominator.
    pub sd: f64,
}

/// Returns the interval of the difference of the rates of `a` and `b`, each successes of trials, −1
/// … 1.
///
/// R. Newcombe's hybrid of two score intervals ("Interval estimation for the difference between
/// independent proportions", 1998, method 10).
///
/// ```
/// use tolman_stats::rate_difference_interval;
///
/// // 56 of 70 against 48 of 80, as in Newcombe's paper.
/// let interval = rate_difference_interval((56, 70), (48, 80), 0.95)?;
/// assert!((interval.low - 0.0524).abs() < 1e-4 && (interval.high - 0.3339).abs() < 1e-4);
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If there are no trials, more successes than trials, or the level is not a probability.
pub fn rate_difference_interval(
    a: (u64, u64),
    b: (u64, u64),
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    let rate = |(successes, trials): (u64, u64)| successes as f64 / trials as f64;
    let interval = |(successes, trials)| wilson_interval(successes, trials, level);
    let (of_a, of_b) = (interval(a)?, interval(b)?);
    let (rate_a, rate_b) = (rate(a), rate(b));
    let below = (rate_a - of_a.low).hypot(of_b.high - rate_b);
    let above = (of_a.high - rate_a).hypot(rate_b - of_b.low);
    let difference = rate_a - rate_b;
    Ok(ConfidenceInterval::new(
        difference - below,
        difference + above,
    ))
}

/// Returns the interval of the difference of the means of `a` and `b`, whose spreads may differ.
///
/// B. Welch ("The generalization of 'Student's' problem when several different population variances
/// are involved", 1947), with his degrees of freedom. It takes the means for normal.
///
/// ```
/// use tolman_stats::{SampleSummary, mean_difference_interval};
///
/// let a = SampleSummary { count: 10, mean: 5.0, sd: 2.0 };
/// let b = SampleSummary { count: 10, mean: 4.0, sd: 2.0 };
/// // Student's 2.1009 for 18 degrees of freedom, times the standard error 0.8944.
/// let interval = mean_difference_interval(a, b, 0.95)?;
/// assert!((interval.high - 1.0 - 2.1009 * 0.8944).abs() < 1e-3);
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If a sample has fewer than two values or a spread that is not a number ≥ 0, or the level is no
/// probability.
pub fn mean_difference_interval(
    a: SampleSummary,
    b: SampleSummary,
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    check_probability(level)?;
    let [(var_a, df_a), (var_b, df_b)] = [error_variance(a)?, error_variance(b)?];
    let (difference, variance) = (a.mean - b.mean, var_a + var_b);
    if variance <= 0.0 {
        return Ok(ConfidenceInterval::new(difference, difference));
    }
    let df = variance * variance / (var_a * var_a / df_a + var_b * var_b / df_b);
    let half = student_quantile(level, df) * variance.sqrt();
    Ok(ConfidenceInterval::new(
        difference - half,
        difference + half,
    ))
}

/// Returns the variance of a sample's mean, and its degrees of freedom.
fn error_variance(sample: SampleSummary) -> Result<(f64, f64), SampleError> {
    let SampleSummary { count, mean, sd } = sample;
    if count < 2 {
        return Err(SampleError::TooSmall {
            count: count as usize,
            needed: 2,
        });
    }
    for value in [mean, sd] {
        if !value.is_finite() || sd < 0.0 {
            return Err(SampleError::NotFinite { index: 0, value });
        }
    }
    Ok((sd * sd / count as f64, count as f64 - 1.0))
}

/// Returns the bound within which Student's t stays, on both sides of 0, with probability `level`.
/// By bisection over the incomplete beta function.
fn student_quantile(level: f64, df: f64) -> f64 {
    let within = |t: f64| 1.0 - regularized_incomplete_beta(0.5 * df, 0.5, df / (df + t * t));
    let (mut low, mut high) = (0.0, 1.0);
    while within(high) < level && high < 1e12 {
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if within(middle) < level {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_quantiles_are_those_of_tables() {
        for (df, expect) in [
            (1.0, 12.7062),
            (4.0, 2.7764),
            (24.0, 2.0639),
            (1000.0, 1.9623),
        ] {
            let found = student_quantile(0.95, df);
            assert!((found - expect).abs() < 1e-4, "{df}: {found}");
        }
    }

    #[test]
    fn rates_at_the_ends_stay_within_their_range() {
        let interval = rate_difference_interval((25, 25), (0, 25), 0.95).unwrap();
        assert!(
            interval.low > 0.7 && interval.high <= 1.0 + 1e-12,
            "{interval:?}"
        );
        let same = rate_difference_interval((25, 25), (25, 25), 0.95).unwrap();
        assert!(same.low < -0.1 && same.high > 0.1, "{same:?}");
    }

    #[test]
    fn what_is_no_sample_is_refused() {
        let one = SampleSummary {
            count: 1,
            mean: 0.0,
            sd: 0.0,
        };
        let endless = SampleSummary {
            count: 9,
            sd: f64::NAN,
            ..one
        };
        assert!(mean_difference_interval(one, one, 0.95).is_err());
        assert!(mean_difference_interval(endless, endless, 0.95).is_err());
        assert!(rate_difference_interval((1, 0), (1, 2), 0.95).is_err());
    }
}
