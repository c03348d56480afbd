//! A build without the feature `live`: nothing is drawn.

use core::ops::ControlFlow;
use std::io::{self, IsTerminal, Write};

use tolman_film::Glimpse;

use super::{Now, Scene};
use crate::cli::Result;

/// Stands in for the screen. It has no values.
#[derive(Debug)]
pub(in crate::cli) enum Screen {}

/// Prints how to build a `tolman` that draws, and returns no screen.
pub(super) fn screen(_: Scene) -> Result<Option<Screen>> {
    if io::stdout().is_terminal() {
        let told = "note: this build draws no picture; one with `--features live` does";
        writeln!(io::stderr(), "{told}")?;
    }
    Ok(None)
}

impl Screen {
    pub(super) const fn take(&mut self, _: &Now<'_>) {
        match *self {}
    }

    pub(super) fn know(&mut self, _: Glimpse) {
        match *self {}
    }

    pub(super) const fn until_next_step(&mut self) -> io::Result<ControlFlow<()>> {
        match *self {}
    }

    pub(super) const fn until_closed(&mut self, _: &str) -> io::Result<()> {
        match *self {}
    }
}
