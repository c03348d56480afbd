//! Effect size.

use super::SampleError;
use super::mann_whitney::u_statistic;
use super::moments::count;

/// Returns Vargha and Delaney's A₁₂ ("A critique and improvement of the CL common language effect
/// size statistics", 2000). It is the probability that a value of `a` is greater than one of `b`;
/// ties count half. 0.5 means no difference. O(n log n).
///
/// ```
/// use tolman_stats::a12;
///
/// assert_eq!(a12(&[2.0, 3.0], &[1.0, 2.0]), Ok(0.875));
/// ```
///
/// # Errors
/// If a sample is empty or not finite.
pub fn a12(a: &[f64], b: &[f64]) -> Result<f64, SampleError> {
    let (u, _) = u_statistic(a, b)?;
    Ok(u / (count(a) * count(b)))
}
