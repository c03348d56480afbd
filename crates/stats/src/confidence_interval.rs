//! Confidence intervals.

/// The ends of a confidence interval.
///
/// ```
/// use tolman_stats::median_interval;
///
/// let steps: Vec<f64> = (1..=25).map(f64::from).collect();
/// let interval = median_interval(&steps, 0.95)?;
/// assert!(interval.contains(13.0));
/// let seconds = interval.scaled(0.1);
/// assert!(seconds.low < 1.3 && seconds.high > 1.3);
/// # Ok::<(), tolman_stats::SampleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfidenceInterval {
    /// Lower end, in the unit of the sample.
    pub low: f64,
    /// Upper end, in the unit of the sample.
    pub high: f64,
}

impl ConfidenceInterval {
    /// Returns the interval from `low` to `high`.
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// Returns whether a value lies between the ends or on one of them.
    pub fn contains(self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Returns both ends times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            low: self.low * factor,
            high: self.high * factor,
        }
    }
}
