//! The bias-corrected and accelerated bootstrap.

use rand::{Rng, RngExt};

use super::error::check_probability;
use super::moments::{self, count};
use super::quantile::{of_sorted, sorted};
use super::{ConfidenceInterval, SampleError, normal};

/// The BCa bootstrap interval of a statistic (Efron, "Better bootstrap confidence intervals", 1987).
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
/// If the sample has fewer than two values or more than 2³², there are no resamples, the level is
/// no probability, or the statistic is not finite.
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

/// The BCa interval of a statistic with the value `estimate`, from its bootstrap replicates and its
/// jackknife values.
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
