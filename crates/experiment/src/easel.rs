//! Where a procedure draws its figures.

use super::pictures::Pictures;
use super::{BoxError, Experiment, Progress};
use tolman_draw::Figure;

/// Where a [`Procedure`](super::Procedure) draws figures that take time. It keeps what is finished
/// in the folder of results, as runs are kept, so an interrupted experiment draws it only once.
#[derive(Clone, Copy)]
pub struct Easel<'a> {
    pub(super) experiment: &'a Experiment,
    pub(super) pictures: &'a Pictures,
    pub(super) progress: &'a dyn Progress,
}

/// The caller asked to stop before all figures were drawn.
#[derive(Debug, thiserror::Error)]
#[error("stopped before all figures were drawn")]
pub(super) struct Stopped;

impl Easel<'_> {
    /// Returns figures of a table, drawn now or by an earlier process. `name` tells them from all
    /// others of the experiment. There are none if the caller left the table out.
    ///
    /// # Errors
    /// That of `draw`, or if the caller asked to stop. Hand it on.
    pub fn draw<F: IntoIterator<Item = Figure>>(
        &self,
        name: &str,
        table: &str,
        draw: impl FnOnce() -> Result<F, BoxError>,
    ) -> Result<Vec<Figure>, BoxError> {
        if !self.experiment.fills(table) {
            return Ok(Vec::new());
        }
        self.pictures.figures(name, || {
            if self.progress.stop_requested() {
                return Err(Stopped.into());
            }
            let figures = draw()?.into_iter();
            Ok(figures.map(|figure| figure.table(table)).collect())
        })
    }
}

impl core::fmt::Debug for Easel<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Easel").finish_non_exhaustive()
    }
}
