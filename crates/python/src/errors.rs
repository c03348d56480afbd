use core::error::Error;
use std::io;

use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

/// Returns a `ValueError` that names the parameter and its fault, with all underlying reasons.
pub(crate) fn refused(parameter: &str, error: &(dyn Error + 'static)) -> PyErr {
    PyValueError::new_err(format!("{parameter}: {}", reasons(error)))
}

/// Returns a `ValueError` with a sentence that names the parameter itself.
pub(crate) fn wrong(sentence: String) -> PyErr {
    PyValueError::new_err(sentence)
}

/// Returns Python's `OSError` for a file that cannot be read or written, with the file's name.
pub(crate) fn unread(name: &str, error: &io::Error) -> PyErr {
    PyErr::from(io::Error::new(
        error.kind(),
        format!("cannot open {name}: {error}"),
    ))
}

/// Returns an error and its causes as one sentence.
pub(crate) fn reasons(error: &(dyn Error + 'static)) -> String {
    let mut told = error.to_string();
    let mut behind = error.source();
    while let Some(reason) = behind {
        told = format!("{told}: {reason}");
        behind = reason.source();
    }
    told
}
