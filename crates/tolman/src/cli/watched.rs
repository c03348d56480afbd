//! Shows an outing on the terminal, with its map and its belief.

use anyhow::Context;
use tolman_arena::Outing;
use tolman_film::Film;

use super::Failure;
use super::live::{Live, Now, Scene};

/// A view of an outing.
#[derive(Debug)]
pub(super) struct Watched {
    live: Live,
    /// Number of poses of the path that have been shown.
    shown: usize,
}

impl Watched {
    /// Opens the view of an outing that is about to begin. `word` names the system that drives.
    ///
    /// # Errors
    /// If there is no terminal, or it is too small.
    pub(super) fn open(
        outing: &dyn Outing,
        word: &str,
        seed: u64,
        step_limit: Option<u32>,
    ) -> Result<Self, Failure> {
        let live = Live::open(Scene {
            course: outing.course().clone(),
            word: word.to_owned(),
            seed,
            start: outing.path()[0],
            step_us: outing.robot().step_us,
            radius: outing.robot().body.radius(),
            step_limit,
        })?;
        Ok(Self { live, shown: 1 })
    }

    /// Shows the steps of an action, and the system's knowledge after it.
    pub(super) fn see(&mut self, outing: &dyn Outing, film: &Film) {
        let words = outing.words();
        let (path, bumped) = (outing.path(), outing.bumped());
        self.live.know(|| film.glimpse());
        for (step, pose) in path.iter().enumerate().skip(self.shown) {
            self.live.watch(&Now {
                pose: *pose,
                bump: bumped.binary_search(&(step as u32)).is_ok(),
                action: &words,
                ended: None,
                scan: outing.scan(),
            });
        }
        self.skip(outing);
    }

    /// Skips the steps driven so far that have not been shown.
    pub(super) fn skip(&mut self, outing: &dyn Outing) {
        self.shown = outing.path().len();
    }

    /// Shows the outcome until the viewer closes it.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(super) fn close(self, told: &str) -> Result<(), Failure> {
        Ok(self.live.close(told).context("the terminal has gone")?)
    }
}
