//! The errors of all units decay at once.

use crate::QuantizerConfigError;
use crate::error::within;

/// A common factor of many sums. All decay by one multiplication instead of a sweep, since each sum
/// is stored divided by the factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decay {
    factor: f64,
}

/// Value below which the factor is reset to 1: long before numbers lose precision, and so rarely
/// that it costs nothing.
const SMALLEST: f64 = 1.0 / (1_u64 << 63) as f64;

impl Decay {
    pub(super) fn none_yet() -> Self {
        Self { factor: 1.0 }
    }

    /// Refuses a factor below 2⁻⁶³ or above 1.
    pub(super) fn with_factor(factor: f64) -> Result<Self, QuantizerConfigError> {
        let holds = |factor| (SMALLEST..=1.0).contains(&factor);
        within("factor", factor, (holds, "between 2⁻⁶³ and 1"))?;
        Ok(Self { factor })
    }

    pub(super) fn factor(self) -> f64 {
        self.factor
    }

    /// Returns the number to keep for `value`.
    #[inline]
    pub(super) fn kept(self, value: f64) -> f64 {
        value / self.factor
    }

    /// Returns the value that a kept number stands for.
    #[inline]
    pub(super) fn value(self, kept: f64) -> f64 {
        kept * self.factor
    }

    /// Multiplies all values by `rate`. If the factor has become too small, it returns a number by
    /// which every kept number has to be multiplied.
    #[inline]
    #[must_use]
    pub(super) fn decay(&mut self, rate: f64) -> Option<f64> {
        self.factor *= rate;
        if self.factor >= SMALLEST {
            return None;
        }
        let due = self.factor;
        self.factor = 1.0;
        Some(due)
    }
}
