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

use core::ops::ControlFlow;
use std::io;

use indicatif::ProgressBar;
pub(super) use scene::{Now, Scene, see};
use terminal::Screen;
use tolman_film::Glimpse;

use crate::cli::Failure;
use crate::cli::bar::bar;

/// A view of a run.
#[derive(Debug)]
pub(super) enum Live {
    /// The run fills the terminal, at the pace of the viewer.
    Screen(Box<Screen>),
    /// The run is one line on stderr, at full speed.
    Line(ProgressBar),
    /// The viewer has closed the view, or the terminal has gone.
    Closed(io::Result<()>),
}

impl Live {
    /// Returns a view of the run that is about to begin.
    pub(super) fn open(scene: Scene) -> Result<Self, Failure> {
        let limit = scene.step_limit;
        if let Some(screen) = terminal::screen(scene)? {
            let mut live = Self::Screen(Box::new(screen));
            live.wait();
            return Ok(live);
        }
        let (length, template) = match limit {
            Some(limit) => (limit, "{bar:30} step {pos} of {len}, at {msg}"),
            None => (0, "{spinner} step {pos}, at {msg}"),
        };
        Ok(Self::Line(bar(length, template)))
    }

    /// Shows one more step until the next is due.
    pub(super) fn watch(&mut self, now: &Now<'_>) {
        match self {
            Self::Screen(screen) => {
                screen.take(now);
                self.wait();
            }
            Self::Line(line) => {
                let position = now.pose.position;
                line.set_message(format!("{:.2}, {:.2} m", position.x, position.y));
                line.inc(1);
            }
            Self::Closed(_) => {}
        }
    }

    /// Shows the system's present knowledge. Only a picture uses it.
    pub(super) fn know(&mut self, glimpse: impl FnOnce() -> Glimpse) {
        if let Self::Screen(screen) = self {
            screen.know(glimpse());
        }
    }

    fn wait(&mut self) {
        if let Self::Screen(screen) = self {
            match screen.until_next_step() {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => *self = Self::Closed(Ok(())),
                Err(error) => *self = Self::Closed(Err(error)),
            }
        }
    }

    /// Shows the outcome, `told` in words, until the viewer closes it.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(super) fn close(self, told: &str) -> io::Result<()> {
        match self {
            Self::Screen(mut screen) => screen.until_closed(told),
            Self::Line(line) => {
                line.finish_and_clear();
                Ok(())
            }
            Self::Closed(done) => done,
        }
    }
}
