//! A run that fills the terminal: draws it, keeps its pace and reads the keys.

use alloc::sync::Arc;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::io;
use std::time::Instant;

use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event};
use tolman_film::Glimpse;

use super::pace::{Motion, Pace};
use super::view::View;
use super::wish::Wish;
use crate::cli::interrupt::INTERRUPTED;
use crate::cli::live::Now;

/// Shortest time between two frames.
const FRAME: Duration = Duration::from_millis(33);

/// Longest wait between two looks at the interrupt flag.
const GLANCE: Duration = Duration::from_millis(100);

/// A run on the terminal. Dropping it restores the terminal.
#[derive(Debug)]
pub(in crate::cli) struct Screen {
    terminal: DefaultTerminal,
    view: View,
    pace: Pace,
    /// Time at which the next step is due.
    due: Instant,
    /// Time at which the last frame was drawn, and whether it is out of date.
    drawn: Instant,
    stale: bool,
    interrupted: Arc<AtomicBool>,
}

impl Screen {
    /// Takes the terminal and shows the run before its first step. A panic restores the terminal,
    /// too.
    ///
    /// # Errors
    /// If nothing can be drawn on the terminal; it is left as it was.
    pub(super) fn open(view: View, interrupted: Arc<AtomicBool>) -> io::Result<Self> {
        let terminal = ratatui::try_init().inspect_err(|_| give_back())?;
        let now = Instant::now();
        Ok(Self {
            terminal,
            view,
            pace: Pace::default(),
            due: now,
            drawn: now,
            stale: true,
            interrupted,
        })
    }

    /// Adds one more step to the view.
    pub(in crate::cli::live) fn take(&mut self, now: &Now<'_>) {
        self.stale = true;
        self.view.take(now);
    }

    /// Sets the system's present knowledge.
    pub(in crate::cli::live) fn know(&mut self, known: Glimpse) {
        self.stale = true;
        self.view.known = known;
    }

    /// Shows the view until the next step is due. Breaks if the viewer has closed it.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(in crate::cli::live) fn until_next_step(&mut self) -> io::Result<ControlFlow<()>> {
        let now = Instant::now();
        // After a pause the run is far behind its schedule; it does not catch up.
        let late = now.saturating_duration_since(self.due) > GLANCE;
        self.due = if late { now } else { self.due } + self.pace.period();
        loop {
            let now = Instant::now();
            let left = match self.pace.motion {
                Motion::Running => self.due.saturating_duration_since(now),
                Motion::Paused => GLANCE,
            };
            let wish = self.wish(left)?;
            match wish {
                Some(Wish::Step) => {
                    self.pace.motion = Motion::Paused;
                    self.stale = true;
                    return Ok(ControlFlow::Continue(()));
                }
                Some(Wish::Close) => return Ok(ControlFlow::Break(())),
                Some(wish) => self.grant(wish),
                None if left.is_zero() => return Ok(ControlFlow::Continue(())),
                None => {}
            }
        }
    }

    /// Shows the outcome until the viewer closes it.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(in crate::cli::live) fn until_closed(&mut self, told: &str) -> io::Result<()> {
        self.stale = true;
        self.view.told = Some(told.to_owned());
        loop {
            match self.wish(GLANCE)? {
                Some(Wish::Close) => return Ok(()),
                Some(wish) => self.grant(wish),
                None => {}
            }
        }
    }

    fn grant(&mut self, wish: Wish) {
        self.stale = true;
        match wish {
            Wish::PauseOrGoOn => {
                self.pace.pause_or_go_on();
                self.due = Instant::now();
            }
            Wish::Faster => {
                self.pace.faster();
                self.due = self.due.min(Instant::now() + self.pace.period());
            }
            Wish::Slower => self.pace.slower(),
            Wish::Beams => self.view.show_or_hide_beams(),
            Wish::Interrupt => {
                give_back();
                std::process::exit(INTERRUPTED.into());
            }
            Wish::Step | Wish::Close => {}
        }
    }

    /// Draws outdated parts, and waits up to `at_most` for a key. Returns the wish of that key.
    fn wish(&mut self, at_most: Duration) -> io::Result<Option<Wish>> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Ok(Some(Wish::Interrupt));
        }
        let mut wait = at_most.min(GLANCE);
        if self.stale {
            let age = self.drawn.elapsed();
            if age >= FRAME {
                let Self { view, pace, .. } = self;
                self.terminal.draw(|frame| view.draw(frame, *pace))?;
                self.drawn = Instant::now();
                self.stale = false;
            } else {
                wait = wait.min(FRAME - age);
            }
        }
        if !event::poll(wait)? {
            return Ok(None);
        }
        match event::read()? {
            Event::Key(key) => Ok(Wish::of(&key)),
            _ => {
                self.stale = true;
                Ok(None)
            }
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        give_back();
        // The flag is no longer read: from here on the first Ctrl-C ends the program.
        self.interrupted.store(true, Ordering::Relaxed);
    }
}

/// Restores the terminal. Errors of a terminal that has gone are ignored.
fn give_back() {
    let _ = ratatui::try_restore();
}
