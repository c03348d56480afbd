//! Samples that cannot be measured.

/// Reason why a statistic is not defined for a sample.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SampleError {
    /// The sample is too small.
    #[error("the sample has {count} values; give {needed} or more")]
    TooSmall {
        /// Number of values given.
        count: usize,
        /// Number of values needed.
        needed: usize,
    },
    /// A value is NaN or infinite.
    #[error(
        "value {index} is {value}; samples must be finite, so leave it out or repair its source"
    )]
    NotFinite {
        /// Index of the value in the sample, from 0.
        index: usize,
        /// Value that was given.
        value: f64,
    },
    /// The values of a paired test do not pair up.
    #[error("a sample of {first} values and one of {second} cannot be paired; give equal lengths")]
    Unpaired {
        /// Number of values in the first sample.
        first: usize,
        /// Number of values in the second sample.
        second: usize,
    },
    /// All values are the same where some difference is needed.
    #[error("all differences are zero, so there is nothing to rank; give samples that differ")]
    NoDifference,
    /// The exact distribution is not known for samples with ties or zeros.
    #[error(
        "the exact test needs samples without ties or zero differences; take the asymptotic one"
    )]
    Ties,
    /// There are more successes than trials.
    #[error("{successes} successes in {trials} trials; successes cannot be more than trials")]
    Successes {
        /// Number of successes.
        successes: u64,
        /// Number of trials.
        trials: u64,
    },
    /// A probability or confidence level out of range.
    #[error("{value} is not a probability; give a number between 0 and 1")]
    Probability {
        /// Value that was given.
        value: f64,
    },
}

/// Refuses a sample that is smaller than `needed` or not finite.
pub(super) fn check(sample: &[f64], needed: usize) -> Result<(), SampleError> {
    if sample.len() < needed {
        return Err(SampleError::TooSmall {
            count: sample.len(),
            needed,
        });
    }
    match sample.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SampleError::NotFinite {
            index,
            value: sample[index],
        }),
        None => Ok(()),
    }
}

/// Refuses a number that is not a probability; 0 and 1 are allowed.
pub(super) fn check_probability(value: f64) -> Result<(), SampleError> {
    if (0.0..=1.0).contains(&value) {
        Ok(())
    } else {
        Err(SampleError::Probability { value })
    }
}
