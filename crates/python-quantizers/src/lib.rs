//! The Rust part of the Python module `tolman_quantizers`: `tolman_quantizers._quantizers`.
//!
//! `python/tolman_quantizers` is the other part: the estimators and their types. Learning and
//! searching happen here, in pieces between which Python runs its other threads and signals.

extern crate alloc;

mod errors;
mod learner;
mod memory;
mod params;
mod rows;
mod shared;

/// The module as Python imports it.
#[pyo3::pymodule]
mod _quantizers {
    #[pymodule_export]
    use crate::learner::PyLearner;
    #[pymodule_export]
    use crate::memory::PyMemory;
}
