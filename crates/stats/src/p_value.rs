//! p-values that do not underflow, and their corrections for many comparisons.

use core::f64::consts::{LN_2, LN_10};
use core::fmt;

/// A p-value, kept as its logarithm: rank tests of a thousand runs go far below the least double.
///
/// Shown with two digits, as `0.043` or `2.1e-341`.
///
/// ```
/// use tolman_stats::{PValue, holm};
///
/// let p_values = [0.01, 0.04, 0.03].map(|p: f64| PValue::from_ln(p.ln()));
/// assert_eq!(p_values[0].to_string(), "0.010");
/// // Of three comparisons, only the first is still evidence at 5 %.
/// let corrected = holm(&p_values);
/// assert_eq!(corrected.iter().filter(|p| p.value() < 0.05).count(), 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct PValue {
    ln: f64,
}

impl PValue {
    /// No evidence at all.
    pub const ONE: Self = Self { ln: 0.0 };

    /// Returns the p-value with this natural logarithm, at most 1.
    pub const fn from_ln(ln: f64) -> Self {
        Self { ln: ln.min(0.0) }
    }

    /// Returns the two-sided p-value of a one-sided tail, given as its logarithm.
    pub(super) const fn two_sided(ln_tail: f64) -> Self {
        Self::from_ln(ln_tail + LN_2)
    }

    /// Returns the p-value itself; 0 where it underflows.
    pub fn value(self) -> f64 {
        libm::exp(self.ln)
    }

    /// Returns the natural logarithm of the p-value.
    pub const fn ln(self) -> f64 {
        self.ln
    }

    /// Returns this p-value times `comparisons`, at most 1.
    fn times(self, comparisons: f64) -> Self {
        Self::from_ln(self.ln + libm::log(comparisons))
    }
}

impl fmt::Display for PValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value();
        if value >= 0.0995 {
            return write!(f, "{value:.2}");
        }
        if value >= 0.00095 {
            let decimals = if value >= 0.00995 { 3 } else { 4 };
            return write!(f, "{value:.decimals$}");
        }
        let log10 = self.ln / LN_10;
        let mut exponent = log10.floor();
        let mut mantissa = libm::pow(10.0, log10 - exponent);
        if mantissa >= 9.95 {
            (mantissa, exponent) = (1.0, exponent + 1.0);
        }
        write!(f, "{mantissa:.1}e{}", exponent as i64)
    }
}

/// Returns every p-value times the number of them: Bonferroni's correction. O(n).
///
/// ```
/// use tolman_stats::{PValue, bonferroni};
///
/// let p = PValue::from_ln(0.01_f64.ln());
/// assert_eq!(bonferroni(&[p, p])[0].to_string(), "0.020");
/// ```
pub fn bonferroni(p_values: &[PValue]) -> Vec<PValue> {
    p_values
        .iter()
        .map(|p| p.times(p_values.len() as f64))
        .collect()
}

/// Returns the p-values by Holm's step-down correction ("A simple sequentially rejective multiple
/// test procedure", 1979), in the order of the input. O(n log n).
pub fn holm(p_values: &[PValue]) -> Vec<PValue> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&a, &b| p_values[a].ln.total_cmp(&p_values[b].ln));
    let mut corrected = p_values.to_vec();
    let mut least = f64::NEG_INFINITY;
    for (passed, &place) in order.iter().enumerate() {
        let p = p_values[place].times((p_values.len() - passed) as f64);
        least = least.max(p.ln);
        corrected[place] = PValue::from_ln(least);
    }
    corrected
}
