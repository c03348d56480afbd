//! `tolman cpm`: the e-puck that learns common-pattern maps.

mod distinct;
mod learn;
mod solve;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Error};
use clap::Subcommand;
use tolman_arena::cpm::{TrialError, Venue};

use super::{Failure, OrBadInput, maze};

/// An e-puck that learns a common-pattern map of a maze, and drives by it
#[derive(Subcommand)]
pub(super) enum Verb {
    Distinct(distinct::Arguments),
    Learn(learn::Arguments),
    Solve(solve::Arguments),
}

impl Verb {
    pub(super) fn carry_out(self, out: &mut dyn Write) -> Result<(), Failure> {
        match self {
            Self::Distinct(arguments) => distinct::carry_out(&arguments, out),
            Self::Learn(arguments) => learn::carry_out(&arguments, out),
            Self::Solve(arguments) => solve::carry_out(&arguments, out),
        }
    }
}

/// A maze or a map that does not serve is the caller's to mend; that a robot came to nothing is not.
fn classify(error: TrialError, context: String) -> Failure {
    let failure = match error {
        TrialError::BrokenOff { .. } => Failure::Interrupted,
        _ if error.is_bad_input() => Failure::BadInput,
        _ => Failure::Failed,
    };
    failure(Error::from(error).context(context))
}

/// Reads a maze file with a start.
///
/// # Errors
/// Bad input.
pub(super) fn venue(path: &Path) -> Result<Venue, Failure> {
    let file = maze::read(path)?;
    let name = maze::name(path);
    Venue::new(&name, file)
        .with_context(|| name.clone())
        .or_bad_input()
}
