//! `tolman cpm`: the e-puck that learns common-pattern maps.

mod distinct;
mod learn;
mod solve;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Error};
use clap::Subcommand;
use tolman_arena::course::Course;
use tolman_arena::cpm::{TrialError, epuck_course, learn};
use tolman_systems::cpm::CommonPatterns;

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

/// Learns common patterns in the learning maze.
///
/// # Errors
/// If the robot fails.
fn learned_patterns(seed: u64) -> Result<CommonPatterns, Failure> {
    let learning = include_str!("../../../../../mazes/cpm-learning.maze");
    let learning = epuck_course("", tolman_maze::read(learning)?)?;
    Ok(learn(&learning, seed)?)
}

/// Reads a maze file with a start.
///
/// # Errors
/// Bad input.
pub(super) fn course(path: &Path) -> Result<Course, Failure> {
    let file = maze::read(path)?;
    let name = maze::name(path);
    epuck_course(&name, file)
        .with_context(|| name.clone())
        .or_bad_input()
}
