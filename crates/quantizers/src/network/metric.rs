//! Checks of inputs, and distances between them.

use alloc::boxed::Box;

use crate::{InputError, QuantizerConfigError, Scalar};

/// Squared distance Σ w (x − p)² over the features of inputs of one size.
#[derive(Clone, Debug)]
pub(crate) struct Metric<S> {
    dimension: usize,
    /// One weight per feature; `None` if all are 1.
    weights: Option<Box<[S]>>,
    /// Maximum magnitude of a feature, so that no squared distance overflows.
    limit: S,
}

impl<S: Scalar> Metric<S> {
    /// Returns the metric in which all weights are 1.
    pub(crate) fn uniform(dimension: usize) -> Result<Self, QuantizerConfigError> {
        if dimension == 0 {
            return Err(QuantizerConfigError::NoFeatures);
        }
        Ok(Self {
            dimension,
            weights: None,
            limit: limit::<S>(dimension as f64),
        })
    }

    /// Returns the metric with these weights of the squares, one per feature.
    pub(crate) fn weighted(weights: &[S]) -> Result<Self, QuantizerConfigError> {
        let mut total = 0.0;
        for (feature, weight) in weights.iter().enumerate() {
            if !weight.is_finite() || *weight < S::ZERO {
                let value = weight.to_f64();
                return Err(QuantizerConfigError::BadWeight { feature, value });
            }
            total += weight.to_f64();
        }
        if weights.is_empty() {
            return Err(QuantizerConfigError::NoFeatures);
        }
        if total <= 0.0 {
            return Err(QuantizerConfigError::NoWeight);
        }
        Ok(Self {
            dimension: weights.len(),
            weights: Some(weights.into()),
            // Without weights the squared distance must not overflow either: relative errors use
            // it.
            limit: limit::<S>(total.max(weights.len() as f64)),
        })
    }

    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    pub(crate) fn weights(&self) -> Option<&[S]> {
        self.weights.as_deref()
    }

    /// Checks that `input` can be learned or searched for.
    #[inline]
    pub(crate) fn check(&self, input: &[S]) -> Result<(), InputError> {
        InputError::check_size(self.dimension, input.len())?;
        // A comparison with NaN is false, so this catches it as well. Values are compared in lanes,
        // and one by one only to find the first that is wrong.
        let mut all = true;
        for value in input {
            all &= self.allows(*value);
        }
        if all {
            return Ok(());
        }
        let wrong = input.iter().position(|value| !self.allows(*value));
        wrong.map_or(
            Ok(()),
            |feature| Err(self.complain(feature, input[feature])),
        )
    }

    /// Checks that a prototype can come from valid inputs: rounding may put it slightly beyond the
    /// limit.
    pub(crate) fn check_prototype(&self, prototype: &[S]) -> Result<(), InputError> {
        let slack = S::from_f64(1.0 + 1e-4);
        let near = Self {
            dimension: self.dimension,
            weights: None,
            limit: self.limit * slack,
        };
        near.check(prototype)
    }

    /// Checks that `input` can be searched for in the features where `mask` is true.
    pub(crate) fn check_masked(&self, input: &[S], mask: &[bool]) -> Result<(), InputError> {
        InputError::check_size(self.dimension, input.len())?;
        if mask.len() != self.dimension {
            return Err(InputError::WrongMask {
                expected: self.dimension,
                found: mask.len(),
            });
        }
        let mut counts = false;
        for (feature, (value, compared)) in input.iter().zip(mask).enumerate() {
            if *compared {
                if !self.allows(*value) {
                    return Err(self.complain(feature, *value));
                }
                counts |= self
                    .weights()
                    .is_none_or(|weights| weights[feature] > S::ZERO);
            }
        }
        if counts {
            Ok(())
        } else {
            Err(InputError::NothingCompared)
        }
    }

    #[inline(always)]
    fn allows(&self, value: S) -> bool {
        value <= self.limit && S::ZERO - value <= self.limit
    }

    #[cold]
    fn complain(&self, feature: usize, value: S) -> InputError {
        let value = value.to_f64();
        if value.is_finite() {
            let limit = self.limit.to_f64();
            InputError::TooLarge {
                feature,
                value,
                limit,
            }
        } else {
            InputError::NotFinite { feature, value }
        }
    }
}

/// Returns the maximum magnitude of a feature. Two values within ± limit are at most 2 limits
/// apart. Rounding may put a prototype slightly beyond the limit, so the divisor is 4, not 2.
fn limit<S: Scalar>(total_weight: f64) -> S {
    S::from_f64(libm::sqrt(S::MAX_SQUARED_DISTANCE / total_weight) / 4.0)
}
