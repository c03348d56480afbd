//! `tolman mouse --mms`: a mouse that a simulator hosts.

use std::io::{self, Write};

use anyhow::Error;
use tolman_systems::micromouse::Until;
use tolman_systems::micromouse::mms::{PlayError, play};

use crate::cli::{OrBadInput, Result};

/// Speaks the protocol of mms on stdin and `out`; the log goes to stderr.
pub(super) fn carry_out(until: Until, out: &mut dyn Write) -> Result {
    match play(io::stdin().lock(), out, io::stderr().lock(), until) {
        Ok(_) => Ok(()),
        // The simulator's output is this program's input.
        Err(error @ (PlayError::Reply { .. } | PlayError::TooLarge(_))) => {
            Err(error).or_bad_input()
        }
        // If the simulator closes the pipe, that is an error: unlike `head`, it has not just seen
        // enough.
        Err(error @ PlayError::HostGone { .. }) => Err(Error::msg(error.to_string()).into()),
        Err(error) => Err(error.into()),
    }
}
