//! Mean and standard deviation.

use super::SampleError;
use super::error::check;

/// Returns the arithmetic mean. O(n).
///
/// # Errors
/// If the sample is empty or not finite.
pub fn mean(sample: &[f64]) -> Result<f64, SampleError> {
    check(sample, 1)?;
    Ok(of(sample))
}

/// Returns the standard deviation of a sample, with n − 1 in the denominator. O(n).
///
/// ```
/// use tolman_stats::standard_deviation;
///
/// assert_eq!(standard_deviation(&[1.0, 3.0]), Ok(2.0_f64.sqrt()));
/// ```
///
/// # Errors
/// If the sample has fewer than two values or is not finite.
pub fn standard_deviation(sample: &[f64]) -> Result<f64, SampleError> {
    check(sample, 2)?;
    let mean = of(sample);
    // Two passes: the differences are small even where the values are large.
    let squares: f64 = sample
        .iter()
        .map(|value| (value - mean) * (value - mean))
        .sum();
    Ok((squares / (count(sample) - 1.0)).sqrt())
}

/// Returns the mean of a sample that is known to have a value.
pub(super) fn of(sample: &[f64]) -> f64 {
    sample.iter().sum::<f64>() / count(sample)
}

/// Returns the size of a sample as a number.
pub(super) fn count<T>(sample: &[T]) -> f64 {
    sample.len() as f64
}
