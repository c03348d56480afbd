use numpy::ndarray::ArrayView2;
use numpy::{Element, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use tolman_quantizers::{InputError, Network, Scalar};

use crate::errors::{refused, wrong};

/// Returns the rows of an array without a copy.
///
/// # Errors
/// A `ValueError` that says how `X` has to be, if it is not a two-dimensional array of this type.
pub(crate) fn rows<'py, S: Element>(x: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray2<'py, S>> {
    x.extract::<PyReadonlyArray2<'py, S>>().map_err(|_| {
        let dimensions = x.cast::<PyUntypedArray>().map(PyUntypedArrayMethods::ndim);
        match dimensions {
            Ok(2) | Err(_) => wrong("X has to be an array of numbers".to_owned()),
            Ok(found) => wrong(format!(
                "X has {found} dimensions but has to have 2: one row an input; a single input is X.reshape(1, -1)"
            )),
        }
    })
}

/// Checks all rows before any is learned, so that either all of them are learned or none.
///
/// # Errors
/// A `ValueError` that names the first invalid row.
pub(crate) fn check<S: Scalar>(network: &Network<S>, x: &ArrayView2<'_, S>) -> PyResult<()> {
    each(x, |input| network.check(input))
}

/// Calls `visit` with each row, in order, until it fails.
///
/// # Errors
/// A `ValueError` that names the row at which it failed.
pub(crate) fn each<S: Scalar>(
    x: &ArrayView2<'_, S>,
    mut visit: impl FnMut(&[S]) -> Result<(), InputError>,
) -> PyResult<()> {
    // Rows that are not contiguous in memory are copied one at a time.
    let mut pieces = Vec::new();
    for (number, row) in x.outer_iter().enumerate() {
        let visited = match row.as_slice() {
            Some(row) => visit(row),
            None => {
                pieces.clear();
                pieces.extend(row.iter().copied());
                visit(&pieces)
            }
        };
        visited.map_err(|error| refused(&format!("X, row {number}"), &error))?;
    }
    Ok(())
}
