//! What belongs to the row of a job.

use tolman_experiment::{BoxError, Job};

/// Returns the first item that belongs to the row of a job.
pub(crate) fn row_of<T>(
    job: &Job<'_>,
    items: impl IntoIterator<Item = T>,
    is_of_row: impl FnMut(&T) -> bool,
) -> Result<T, BoxError> {
    let found = items.into_iter().find(is_of_row);
    found.ok_or_else(|| format!("there is no row {:?} of {}", job.row, job.table).into())
}
