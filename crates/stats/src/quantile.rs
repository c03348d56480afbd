//! Quantiles and the five numbers of a box plot.

use super::SampleError;
use super::error::{check, check_probability};

/// Returns the quantile of a sample by definition R-7 (Hyndman and Fan, "Sample quantiles in
/// statistical packages", 1996). It is linear between order statistics, as by default in R and
/// NumPy.
///
/// O(n log n).
///
/// ```
/// use tolman_stats::quantile;
///
/// assert_eq!(quantile(&[4.0, 1.0, 3.0, 2.0], 0.5), Ok(2.5));
/// ```
///
/// # Errors
/// If the sample is empty or not finite, or `probability` is not between 0 and 1.
pub fn quantile(sample: &[f64], probability: f64) -> Result<f64, SampleError> {
    check(sample, 1)?;
    check_probability(probability)?;
    Ok(of_sorted(&sorted(sample), probability))
}

/// The five numbers of Tukey's box plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FiveNumbers {
    /// The least datum within 1.5 interquartile ranges below the lower quartile.
    pub lower_whisker: f64,
    /// The R-7 quantile of 0.25.
    pub lower_quartile: f64,
    /// The R-7 quantile of 0.5.
    pub median: f64,
    /// The R-7 quantile of 0.75.
    pub upper_quartile: f64,
    /// The greatest datum within 1.5 interquartile ranges above the upper quartile.
    pub upper_whisker: f64,
}

/// Returns the five numbers of a box plot. O(n log n).
///
/// # Errors
/// If the sample is empty or not finite.
pub fn five_numbers(sample: &[f64]) -> Result<FiveNumbers, SampleError> {
    check(sample, 1)?;
    let sorted = sorted(sample);
    let [lower_quartile, median, upper_quartile] = [0.25, 0.5, 0.75].map(|p| of_sorted(&sorted, p));
    let reach = 1.5 * (upper_quartile - lower_quartile);
    let within = |value: &f64| (lower_quartile - reach..=upper_quartile + reach).contains(value);
    let inside = sorted.iter().copied().filter(within);
    // A quartile may lie between data, so a whisker could end inside the box; it ends at its edge.
    Ok(FiveNumbers {
        lower_whisker: inside.clone().fold(lower_quartile, f64::min),
        lower_quartile,
        median,
        upper_quartile,
        upper_whisker: inside.fold(upper_quartile, f64::max),
    })
}

pub(super) fn sorted(sample: &[f64]) -> Vec<f64> {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Returns the R-7 quantile of a sorted sample with at least one value.
pub(super) fn of_sorted(sorted: &[f64], probability: f64) -> f64 {
    let place = probability * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - place.floor()) * (sorted[above] - sorted[below])
}
