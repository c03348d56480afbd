//! A run shown as it goes: on the terminal, or as one line where there is none to draw on.
//!
//! Nothing of the run depends on who looks: it is made step by step as ever, and each step waits
//! until it has been shown.

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

/// Somebody's view of a run.
#[derive(Debug)]
pub(super) enum Live {
    /// On the whole terminal, at the pace of who looks.
    Screen(Box<Screen>),
    /// As a line on stderr, as fast as it goes.
    Line(ProgressBar),
    /// No more: who looked has seen enough, or the terminal has gone.
    Closed(io::Result<()>),
}

impl Live {
    /// Returns a view of the run that is about to be made.
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

    /// Takes in what the system knows by now, which only a picture shows.
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

    /// Shows the outcome until who looks has seen enough.
    ///
    /// # Errors
    /// If the terminal has gone meanwhile.
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
