//! How a p-value is found.

/// How a rank test finds its p-value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Exact for small samples without ties, else asymptotic.
    #[default]
    Auto,
    /// From the exact distribution; refused if there are ties.
    Exact,
    /// From the normal distribution, with corrections for ties and continuity.
    Asymptotic,
}
