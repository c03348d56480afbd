//! Methods of computing a p-value.

use super::SampleError;

/// Method by which a rank test computes its p-value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Exact for small samples without ties, else asymptotic.
    #[default]
    Auto,
    /// Computes the exact distribution; refused if there are ties.
    Exact,
    /// Uses the normal distribution, with corrections for ties and continuity.
    Asymptotic,
}

impl Method {
    /// Returns the method to take for a sample that `is_small` or not, and has ties or not.
    pub(super) const fn of(self, has_ties: bool, is_small: bool) -> Result<Self, SampleError> {
        match self {
            Self::Exact if has_ties => Err(SampleError::Ties),
            Self::Auto if is_small && !has_ties => Ok(Self::Exact),
            Self::Auto => Ok(Self::Asymptotic),
            chosen => Ok(chosen),
        }
    }
}
