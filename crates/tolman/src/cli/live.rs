//! A run shown as it goes: on the terminal, or as one line where there is none to draw on.
//!
//! Nothing of the run depends on who looks: it is made step by step as ever, and each step waits
//! until it has been shown.

mod pace;
mod palette;
mod picture;
mod screen;
mod view;
mod window;
mod wish;

use core::ops::ControlFlow;
use std::io::{self, IsTerminal};

use indicatif::ProgressBar;
use ratatui::crossterm::terminal;
use screen::Screen;
use tolman_papers::Glimpse;
use view::{LEAST_COLUMNS, LEAST_ROWS, View};
pub(super) use view::{Now, Scene, see};

use crate::cli::bar::bar;
use crate::cli::{Failure, ink, interrupt};

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
        if on_terminal() {
            let view = View::new(scene, ink());
            // A terminal that cannot be drawn on, as without a keyboard, gets the line.
            if let Ok(screen) = Screen::open(view, interrupt::flag()?) {
                let mut live = Self::Screen(Box::new(screen));
                live.wait();
                return Ok(live);
            }
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
                screen.view().take(now);
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
            screen.view().known = glimpse();
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
            Self::Screen(mut screen) => {
                screen.view().told = Some(told.to_owned());
                screen.until_closed()
            }
            Self::Line(line) => {
                line.finish_and_clear();
                Ok(())
            }
            Self::Closed(done) => done,
        }
    }
}

/// Returns whether stdout is a terminal large and able enough to draw on.
fn on_terminal() -> bool {
    // Unix names its terminals; one without a name can do as little as a dumb one.
    let able = std::env::var_os("TERM").map_or(cfg!(windows), |terminal| terminal != "dumb");
    let large = |(columns, rows)| columns >= LEAST_COLUMNS && rows >= LEAST_ROWS;
    able && io::stdout().is_terminal() && terminal::size().is_ok_and(large)
}
