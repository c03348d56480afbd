//! Bootstraps: the bias-corrected and accelerated one, and the plain one of the mean.

use rand::{Rng, RngExt};

use super::error::check_probability;
use super::moments::{self, count};
use super::quantile::{of_sorted, sorted};
use super::{ConfidenceInterval, SampleError, normal};

/// Returns the BCa bootstrap interval of a statistic (Efron, "Better bootstrap confidence
/// intervals", 1987).
///
/// `statistic` is called with samples of the size of `sample` and, for the acceleration, with
/// samples that lack one value. Draws `resamples` × n random indices from `rng`; the same generator
/// gives the same interval.
///
/// O((resamples + n) × cost of the statistic).
///
/// ```
/// use rand::SeedableRng;
/// use rand_chacha::ChaCha8Rng;
/// use tolman_stats::bca_interval;
///
/// let sample: Vec<f64> = (1..=30).map(f64::from).collect();
/// let mean = |sample: &[f64]| sample.iter().sum::<f64>() / sample.len() as f64;
/// let mut rng = ChaCha8Rng::seed_from_u64(1);
/// let interval = bca_interval(&sample, mean, 2000, 0.95, &mut rng)?;
/// assert!(interval.contains(15.5) && !interval.contains(20.0));
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If the sample has fewer than two values or more than 2³², or the statistic is not finite. Also
/// if there are no resamples or the level is not a probability.
pub fn bca_interval<T: Copy>(
    sample: &[T],
    statistic: impl Fn(&[T]) -> f64,
    resamples: u32,
    level: f64,
    rng: &mut impl Rng,
) -> Result<ConfidenceInterval, SampleError> {
    let too_small = || SampleError::TooSmall {
        count: sample.len(),
        needed: 2,
    };
    let size = u32::try_from(sample.len()).map_err(|_| too_small())?;
    if size < 2 {
        return Err(too_small());
    }
    let mut drawn = sample.to_vec();
    let replicates: Vec<f64> = (0..resamples)
        .map(|_| {
            drawn.fill_with(|| sample[rng.random_range(0..size) as usize]);
            statistic(&drawn)
        })
        .collect();
    let jackknife: Vec<f64> = (0..sample.len())
        .map(|left_out| {
            let rest = sample.iter().enumerate().filter(|(i, _)| *i != left_out);
            let rest: Vec<T> = rest.map(|(_, value)| *value).collect();
            statistic(&rest)
        })
        .collect();
    from_replicates(statistic(sample), &replicates, &jackknife, level)
}

/// Returns the BCa interval of a statistic with the value `estimate`, from its bootstrap replicates
/// and its jackknife values.
pub(super) fn from_replicates(
    estimate: f64,
    replicates: &[f64],
    jackknife: &[f64],
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    super::error::check(&[estimate], 1)?;
    super::error::check(replicates, 1)?;
    super::error::check(jackknife, 2)?;
    check_probability(level)?;
    let sorted = sorted(replicates);
    let (least, greatest) = (sorted[0], sorted[sorted.len() - 1]);
    if least >= greatest {
        return Ok(ConfidenceInterval::new(least, greatest));
    }
    let total = count(replicates);
    let below = replicates.iter().filter(|value| **value < estimate).count();
    let not_above = replicates
        .iter()
        .filter(|value| **value <= estimate)
        .count();
    let share = (below + not_above) as f64 / (2.0 * total);
    // An estimate outside all replicates would make the bias infinite; half a replicate is as far
    // as they can tell.
    let bias = normal::quantile(share.clamp(0.5 / total, 1.0 - 0.5 / total));

    let mean = moments::of(jackknife);
    let power = |exponent: i32| -> f64 {
        jackknife
            .iter()
            .map(|value| (0..exponent).fold(1.0, |product, _| product * (mean - value)))
            .sum()
    };
    let spread = power(2);
    let acceleration = if spread > 0.0 {
        power(3) / (6.0 * spread * spread.sqrt())
    } else {
        0.0
    };

    let end = |probability: f64| {
        let shifted = bias + normal::quantile(probability);
        let adjusted = normal::cumulative(bias + shifted / (1.0 - acceleration * shifted));
        of_sorted(&sorted, adjusted)
    };
    let tail = ((1.0 - level) / 2.0).clamp(1e-15, 0.5);
    Ok(ConfidenceInterval::new(end(tail), end(1.0 - tail)))
}

/// Returns the means of `points` values drawn from a sample with replacement, `resamples` times.
/// Unlike in a bootstrap, `points` need not be the size of the sample.
///
/// The spread of the means is σ / √points. With more points than the sample has values, it is
/// smaller than the uncertainty of the mean; [`bca_interval`] gives that.
///
/// O(resamples × points).
///
/// ```
/// use rand::SeedableRng;
/// use rand_chacha::ChaCha8Rng;
/// use tolman_stats::{bootstrap_means, percentile_interval};
///
/// let mut rng = ChaCha8Rng::seed_from_u64(1);
/// let means = bootstrap_means(&[0.0, 1.0], 10_000, 1000, &mut rng)?;
/// // Half of coins show heads, give or take 3.3 of σ / √points = 0.005.
/// let interval = percentile_interval(&means, 0.999)?;
/// assert!(interval.contains(0.5) && !interval.contains(0.52));
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
///
/// # Errors
/// If the sample is empty, not finite or has more than 2³² values, or no points are to be drawn.
pub fn bootstrap_means(
    sample: &[f64],
    points: u32,
    resamples: u32,
    rng: &mut impl Rng,
) -> Result<Vec<f64>, SampleError> {
    super::error::check(sample, 1)?;
    let too_small = |count| SampleError::TooSmall { count, needed: 1 };
    let size = u32::try_from(sample.len()).map_err(|_| too_small(sample.len()))?;
    if points == 0 {
        return Err(too_small(0));
    }
    let mut one = || {
        let drawn = (0..points).map(|_| sample[rng.random_range(0..size) as usize]);
        drawn.sum::<f64>() / f64::from(points)
    };
    Ok((0..resamples).map(|_| one()).collect())
}

/// Returns the interval that holds the middle share `level` of replicates: their R-7 quantiles, as
/// in Efron's percentile method. O(n log n).
///
/// # Errors
/// If there are no replicates, one is not finite, or the level is not a probability.
pub fn percentile_interval(
    replicates: &[f64],
    level: f64,
) -> Result<ConfidenceInterval, SampleError> {
    super::error::check(replicates, 1)?;
    check_probability(level)?;
    let sorted = sorted(replicates);
    let tail = (1.0 - level) / 2.0;
    Ok(ConfidenceInterval::new(
        of_sorted(&sorted, tail),
        of_sorted(&sorted, 1.0 - tail),
    ))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::{mean, standard_deviation};

    #[test]
    fn means_spread_as_sums_of_draws_do() {
        // Of a die: mean 3.5, variance 35/12.
        let die = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let means = bootstrap_means(&die, 400, 4000, &mut rng).unwrap();
        let error = libm::sqrt(35.0 / 12.0 / 400.0);
        assert!((mean(&means).unwrap() - 3.5).abs() < 4.0 * error / libm::sqrt(4000.0));
        assert!((standard_deviation(&means).unwrap() / error - 1.0).abs() < 0.05);
        // 3.29 standard errors to either side hold 99.9 %.
        let interval = percentile_interval(&means, 0.999).unwrap();
        assert!((interval.high - interval.low - 6.58 * error).abs() < error);
    }

    #[test]
    fn percentiles_are_numpy_s() {
        // numpy.quantile(range(1001), [0.0005, 0.9995]), and of four values with level 0.5.
        let many: Vec<f64> = (0..=1000).map(f64::from).collect();
        let interval = percentile_interval(&many, 0.999).unwrap();
        assert!((interval.low - 0.5).abs() < 1e-9 && (interval.high - 999.5).abs() < 1e-9);
        let few = percentile_interval(&[4.0, 1.0, 3.0, 2.0], 0.5).unwrap();
        assert_eq!(few, ConfidenceInterval::new(1.75, 3.25));
    }

    #[test]
    fn nothing_is_drawn_from_nothing() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        assert!(bootstrap_means(&[], 10, 10, &mut rng).is_err());
        assert!(bootstrap_means(&[1.0], 0, 10, &mut rng).is_err());
        assert!(percentile_interval(&[], 0.9).is_err());
        assert!(percentile_interval(&[1.0], 1.1).is_err());
    }
}
