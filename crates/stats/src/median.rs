//! The confidence interval of a median.

use super::beta::regularized_incomplete_beta;
use super::error::{check, check_probability};
use super::quantile::sorted;
use super::{ConfidenceInterval, SampleError};

/// Returns the interval of a median between two order statistics (Conover, "Practical Nonparametric
/// Statistics", 1999, section 3.2). It holds the median of any distribution with at least the
/// probability `level`, and draws no random numbers. It also suits samples with ties, where a
/// bootstrap sees only a few values.
///
/// The ends are the kth least and the kth greatest value. Fewer than k of n fair coins show heads
/// with a probability of at most (1 − level) / 2. k is as great as this allows.
///
/// O(n log n).
///
/// ```
/// use tolman_stats::median_interval;
///
/// // Of 25 values, the 8th from either end.
/// let sample: Vec<f64> = (1..=25).map(f64::from).collect();
/// let interval = median_interval(&sample, 0.95)?;
/// assert_eq!((interval.low, interval.high), (8.0, 18.0));
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If the sample is not finite or `level` is not a probability. Also if the sample is too small:
/// even its least and greatest value then hold the median less often than `level`. 0.95 needs 6
/// values.
pub fn median_interval(sample: &[f64], level: f64) -> Result<ConfidenceInterval, SampleError> {
    check(sample, 1)?;
    check_probability(level)?;
    let tail = (1.0 - level) / 2.0;
    let sorted = sorted(sample);
    // Increases with k, so the ks that serve come first.
    let serves = |k: usize| at_most_heads(k - 1, sorted.len()) <= tail;
    let (mut most, mut beyond) = (0, sorted.len() / 2 + 1);
    while beyond - most > 1 {
        let k = most.midpoint(beyond);
        if serves(k) { most = k } else { beyond = k }
    }
    if most == 0 {
        return Err(SampleError::TooSmall {
            count: sorted.len(),
            needed: least_size(tail),
        });
    }
    Ok(ConfidenceInterval::new(
        sorted[most - 1],
        sorted[sorted.len() - most],
    ))
}

/// Returns the probability that `flips` fair coins show at most `heads` heads, where `heads` is
/// less than `flips`.
fn at_most_heads(heads: usize, flips: usize) -> f64 {
    regularized_incomplete_beta((flips - heads) as f64, heads as f64 + 1.0, 0.5)
}

/// Returns the size from which on all coins show one side with a probability of at most `tail`.
fn least_size(tail: f64) -> usize {
    // A rounded logarithm must not ask for one more.
    (-libm::log2(tail) - 1e-9).ceil() as usize
}
