//! Statistics for comparing samples of runs, tested against SciPy's values in golden files.
//!
//! Samples are slices of finite numbers; anything else is a [`SampleError`]. A [`PValue`] keeps its
//! logarithm, so the deep tails of large samples do not underflow. All functions are deterministic
//! on every platform; the bootstrap draws from the caller's generator.
//!
//! # Two systems compared
//!
//! `cargo run --example compare`:
#![doc = "```"]
#![doc = include_str!("../examples/compare.rs")]
#![doc = "```"]

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use rand;

mod beta;
mod bootstrap;
mod confidence_interval;
mod difference;
mod effect;
mod error;
mod mann_whitney;
mod median;
mod method;
mod moments;
mod normal;
mod p_value;
mod proportion;
mod quantile;
mod ranks;
mod wilcoxon;

#[cfg(test)]
mod tests;

pub use bootstrap::{bca_interval, bootstrap_means, percentile_interval};
pub use confidence_interval::ConfidenceInterval;
pub use difference::{SampleSummary, mean_difference_interval, rate_difference_interval};
pub use effect::a12;
pub use error::SampleError;
pub use mann_whitney::{MannWhitney, mann_whitney};
pub use median::median_interval;
pub use method::Method;
pub use moments::{mean, standard_deviation};
pub use p_value::{PValue, bonferroni, holm};
pub use proportion::{exact_binomial_interval, wilson_interval};
pub use quantile::{FiveNumbers, five_numbers, quantile};
pub use wilcoxon::{Wilcoxon, wilcoxon};
