//! Statistics for comparing samples of runs, held to SciPy's values by golden files.

mod error;
mod quantile;

pub use error::SampleError;
pub use quantile::{FiveNumbers, five_numbers, quantile};
