use thiserror::Error;

/// Reason why numbers do not bound an interval.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IntervalError {
    /// A bound is NaN.
    #[error(
        "the bounds [{low}, {high}] are not both numbers; give numbers, infinite where there is no bound"
    )]
    NotANumber {
        /// Lower bound, as given.
        low: f64,
        /// Upper bound, as given.
        high: f64,
    },
    /// No number lies between the bounds.
    #[error("no number lies in [{low}, {high}]; give the lower bound first")]
    Empty {
        /// Lower bound, as given.
        low: f64,
        /// Upper bound, as given.
        high: f64,
    },
    /// A margin is negative.
    #[error("the margin is {margin}; give 0 or more")]
    NegativeMargin {
        /// Margin that was given.
        margin: f64,
    },
}
