//! `tolman mouse --mms`: the mouse that a simulator hosts.

use std::io::{self, Write};

use tolman_systems::micromouse::mms::{PlayError, Until, play};

use crate::cli::Failure;
use crate::cli::failure::OrBadInput;

/// When the mouse has explored enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum UntilArgument {
    /// It has been at the goal
    Goal,
    /// No run can score less than the best one it knows
    Proof,
}

/// Speaks the protocol of mms with stdin and `out`; the log goes to stderr.
pub(super) fn carry_out(until: UntilArgument, out: &mut dyn Write) -> Result<(), Failure> {
    let until = match until {
        UntilArgument::Goal => Until::Goal,
        UntilArgument::Proof => Until::Proof,
    };
    match play(io::stdin().lock(), out, io::stderr().lock(), until) {
        Ok(_) => Ok(()),
        // What the simulator says is our input.
        Err(error @ (PlayError::Reply { .. } | PlayError::TooLarge(_))) => {
            Err(error).or_bad_input()
        }
        Err(error) => Err(error.into()),
    }
}
