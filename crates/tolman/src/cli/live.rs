//! Shows a run in progress: on the terminal, or as one line where nothing can be drawn.
//!
//! The run does not depend on the viewer. Every step is made as always, and then waits until it has
//! been shown.

#[cfg(not(feature = "live"))]
#[path = "live/no_terminal.rs"]
mod terminal;
#[cfg(feature = "live")]
mod terminal;

mod scene;

use core::mem;
use core::ops::ControlFlow;
use std::io;

use anyhow::Context;
use indicatif::ProgressBar;
pub(super) use scene::{Now, Scene, see};
use terminal::Screen;
use tolman_arena::Outing;
use tolman_film::Film;

use crate::cli::Result;
use crate::cli::bar::bar;

/// A view of a run.
#[derive(Debug)]
pub(super) struct Live {
    shown: Shown,
    /// Number of poses of an outing's path that have been shown.
    poses: usize,
}

/// Where a run is shown.
#[derive(Debug)]
enum Shown {
    /// The run fills the terminal, at the pace of the viewer.
    Screen(Box<Screen>),
    /// The run is one line on stderr, at full speed.
    Line(ProgressBar),
    /// Nobody asked for the view or its viewer has closed it, or the terminal has gone.
    Closed(io::Result<()>),
}

impl Live {
    /// Returns a view of the run that is about to begin; it shows nothing unless it `is_wanted`.
    pub(super) fn open(is_wanted: bool, scene: impl FnOnce() -> Scene) -> Result<Self> {
        let mut live = Self {
            shown: Shown::Closed(Ok(())),
            poses: 1,
        };
        if !is_wanted {
            return Ok(live);
        }
        let scene = scene();
        let limit = scene.step_limit;
        if let Some(screen) = terminal::screen(scene)? {
            live.shown = Shown::Screen(Box::new(screen));
            live.wait();
            return Ok(live);
        }
        let (length, template) = match limit {
            Some(limit) => (limit, "{bar:30} step {pos} of {len}, at {msg}"),
            None => (0, "{spinner} step {pos}, at {msg}"),
        };
        live.shown = Shown::Line(bar(length, template));
        Ok(live)
    }

    /// Shows one more step until the next is due.
    pub(super) fn watch(&mut self, now: &Now<'_>) {
        match &mut self.shown {
            Shown::Screen(screen) => {
                screen.take(now);
                self.wait();
            }
            Shown::Line(line) => {
                let position = now.pose.position;
                line.set_message(format!("{:.2}, {:.2} m", position.x, position.y));
                line.inc(1);
            }
            Shown::Closed(_) => {}
        }
    }

    /// Shows the steps of an outing's last action, and the system's knowledge after it, which only
    /// a picture uses.
    pub(super) fn follow(&mut self, outing: &dyn Outing, film: &Film) {
        let words = outing.words();
        let (path, bumped) = (outing.path(), outing.bumped());
        if let Shown::Screen(screen) = &mut self.shown {
            screen.know(film.glimpse());
        }
        for (step, pose) in path.iter().enumerate().skip(self.poses) {
            self.watch(&Now {
                pose: *pose,
                bump: bumped.binary_search(&(step as u32)).is_ok(),
                action: &words,
                ended: None,
                scan: outing.scan(),
            });
        }
        self.skip(outing);
    }

    /// Skips the steps of an outing that have not been shown.
    pub(super) fn skip(&mut self, outing: &dyn Outing) {
        self.poses = outing.path().len();
    }

    fn wait(&mut self) {
        if let Shown::Screen(screen) = &mut self.shown {
            match screen.until_next_step() {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => self.shown = Shown::Closed(Ok(())),
                Err(error) => self.shown = Shown::Closed(Err(error)),
            }
        }
    }

    /// Shows the outcome, `told` in words, until the viewer closes it.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(super) fn close(&mut self, told: &str) -> Result {
        let closed = match mem::replace(&mut self.shown, Shown::Closed(Ok(()))) {
            Shown::Screen(mut screen) => screen.until_closed(told),
            Shown::Line(line) => {
                line.finish_and_clear();
                Ok(())
            }
            Shown::Closed(done) => done,
        };
        Ok(closed.context("the terminal has gone")?)
    }
}
