use alloc::borrow::Cow;
use core::ops::Range;
use core::time::Duration;
use std::time::Instant;

use numpy::ndarray::{ArrayView2, Axis, Slice};
use numpy::{Element, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use tolman_quantizers::{InputError, Network, Scalar};

use crate::errors::{refused, wrong};

/// Time after which Python gets a chance to handle signals, such as Ctrl-C.
const PIECE: Duration = Duration::from_millis(20);

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

/// Calls `work` with the number of the first row that is left, until it has returned that all
/// `count` are done, with Python's lock released. Between pieces of work it calls `after` with the
/// number of rows done, and lets Python handle signals.
///
/// # Errors
/// The first error of either, or what a signal raises.
pub(crate) fn in_pieces(
    py: Python<'_>,
    count: usize,
    mut work: impl FnMut(usize) -> PyResult<usize> + Send,
    mut after: impl FnMut(usize) -> PyResult<()>,
) -> PyResult<()> {
    let mut done = 0;
    while done < count {
        done = py.detach(|| {
            let begun = Instant::now();
            while done < count && begun.elapsed() < PIECE {
                done = work(done)?;
            }
            PyResult::Ok(done)
        })?;
        py.check_signals()?;
        after(done)?;
    }
    Ok(())
}

/// Returns a number of rows that takes little of a piece.
pub(crate) fn few(dimension: usize) -> usize {
    (65_536 / dimension.max(1)).clamp(1, 64)
}

/// Returns the numbers of some rows in turn; copied only if they do not lie so.
pub(crate) fn flat<'a, S: Scalar>(x: &ArrayView2<'a, S>, range: Range<usize>) -> Cow<'a, [S]> {
    let mut part = *x;
    part.slice_axis_inplace(Axis(0), Slice::from(range));
    match part.to_slice() {
        Some(flat) => Cow::Borrowed(flat),
        None => Cow::Owned(part.iter().copied().collect()),
    }
}

/// Returns the least difference whose square, with the precision that comparing asks for, is a
/// normal number.
pub(crate) fn least_spread<S: Scalar>() -> f64 {
    match size_of::<S>() {
        4 => f64::from(f32::MIN_POSITIVE / f32::EPSILON).sqrt(),
        _ => (f64::MIN_POSITIVE / f64::EPSILON).sqrt(),
    }
}

/// Checks one row.
///
/// # Errors
/// A `ValueError` that names the row.
pub(crate) fn checked<S: Scalar>(network: &Network<S>, input: &[S], number: usize) -> PyResult<()> {
    network.check(input).map_err(|error| in_row(number, &error))
}

/// Returns a `ValueError` that names the row.
pub(crate) fn in_row(number: usize, error: &InputError) -> PyErr {
    refused(&format!("X, row {number}"), error)
}

/// Returns a row as a slice; copied only if its numbers do not lie side by side.
pub(crate) fn row_of<'a, S: Scalar>(x: &ArrayView2<'a, S>, number: usize) -> Cow<'a, [S]> {
    flat(x, number..number + 1)
}
