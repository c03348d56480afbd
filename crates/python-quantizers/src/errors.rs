use core::error::Error;

use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

/// Returns a `ValueError` that names the parameter and its fault.
pub(crate) fn refused(parameter: &str, error: &(dyn Error + 'static)) -> PyErr {
    wrong(format!("{parameter}: {error}"))
}

/// Returns a `ValueError` with a sentence that names the parameter itself.
pub(crate) fn wrong(sentence: String) -> PyErr {
    PyValueError::new_err(sentence)
}
