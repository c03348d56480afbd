//! The nearest unit of each row, by all processors.

use core::cell::Cell;
use core::num::NonZero;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::env;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

use numpy::ndarray::ArrayView2;
use pyo3::prelude::*;
use tolman_quantizers::{Network, Scalar, UnitId};

use super::graph::number;
use crate::errors::wrong;
use crate::rows::{checked, flat, in_row, row_of};

/// Number of rows that a thread takes at once: many, as all units are turned for them.
const ROWS: usize = 1024;

/// Number of features compared that is worth a thread.
const WORTH_A_THREAD: usize = 2_000_000;

/// Time between two looks for signals.
const LOOK: Duration = Duration::from_millis(20);

/// Returns, for each row, the number of the nearest unit and its squared distance. Called with
/// Python's lock released.
///
/// # Errors
/// A `ValueError` that names an invalid row, or what a signal raises.
#[expect(
    clippy::redundant_closure_for_method_calls,
    reason = "the method is of one lifetime alone"
)]
pub(super) fn nearest<S: Scalar>(
    network: &Network<S>,
    x: &ArrayView2<'_, S>,
) -> PyResult<(Vec<i64>, Vec<f64>)> {
    if network.is_empty() {
        return Err(wrong("there are no units yet: learn first".to_owned()));
    }
    let ids: Vec<UnitId> = network.ids().collect();
    let (mut numbers, mut squared) = (vec![0; x.nrows()], vec![0.0; x.nrows()]);
    let parts = numbers.chunks_mut(ROWS).zip(squared.chunks_mut(ROWS));
    let parts = Mutex::new(parts.enumerate());
    let stopped = AtomicBool::new(false);
    let next = || parts.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = |look: &dyn Fn() -> PyResult<()>| {
        let mut found = Vec::with_capacity(ROWS);
        while !stopped.load(Ordering::Relaxed)
            && let Some((part, (numbers, squared))) = next()
        {
            let from = part * ROWS;
            let until = from + numbers.len();
            found.clear();
            if let Err(error) = network.nearest_rows(&flat(x, from..until), &mut found) {
                for row in from..until {
                    checked(network, &row_of(x, row), row)?;
                }
                return Err(in_row(from, &error));
            }
            for ((number_of, squared), nearest) in numbers.iter_mut().zip(squared).zip(&found) {
                *number_of = number(&ids, nearest.id);
                *squared = nearest.squared_distance.to_f64();
            }
            look()?;
        }
        Ok(())
    };
    let work = |look: &dyn Fn() -> PyResult<()>| {
        let done = work(look);
        // Others need not go on once one has failed.
        if done.is_err() {
            stopped.store(true, Ordering::Relaxed);
        }
        done
    };
    let effort = network.len() * network.dimension() * x.nrows();
    let others = threads().min(effort / WORTH_A_THREAD).saturating_sub(1);
    thread::scope(|scope| {
        let others: Vec<_> = (0..others)
            .map(|_| scope.spawn(|| work(&|| Ok(()))))
            .collect();
        let last = Cell::new(Instant::now());
        let mut done = work(&|| {
            if last.get().elapsed() < LOOK {
                return Ok(());
            }
            last.set(Instant::now());
            Python::attach(|py| py.check_signals())
        });
        for other in others {
            let theirs = other.join();
            done = done.and(theirs.unwrap_or_else(|_| Err(wrong("a thread failed".to_owned()))));
        }
        done
    })?;
    Ok((numbers, squared))
}

/// Returns the number of threads to use: one a processor, or as many as `OMP_NUM_THREADS` says,
/// which joblib sets for its workers.
fn threads() -> usize {
    let asked = env::var("OMP_NUM_THREADS").ok();
    let asked = asked.and_then(|asked| asked.parse::<NonZero<usize>>().ok());
    let here = thread::available_parallelism().ok();
    let both = [asked, here].into_iter().flatten();
    both.min().map_or(1, NonZero::get)
}
