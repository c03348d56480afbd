//! `tolman mouse --mms`: the mouse that a simulator hosts.

use std::io::{self, Write};

use anyhow::Error;
use tolman_systems::micromouse::Until;
use tolman_systems::micromouse::mms::{PlayError, play};

use crate::cli::{Failure, OrBadInput};

/// Speaks the protocol of mms with stdin and `out`; the log goes to stderr.
pub(super) fn carry_out(until: Until, out: &mut dyn Write) -> Result<(), Failure> {
    match play(io::stdin().lock(), out, io::stderr().lock(), until) {
        Ok(_) => Ok(()),
        // What the simulator says is our input.
        Err(error @ (PlayError::Reply { .. } | PlayError::TooLarge(_))) => {
            Err(error).or_bad_input()
        }
        // A pipe that a simulator closed is no reader who has seen enough: it is told.
        Err(error @ PlayError::HostGone { .. }) => Err(Error::msg(error.to_string()).into()),
        Err(error) => Err(error.into()),
    }
}
