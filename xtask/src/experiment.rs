//! `cargo xtask experiment`: runs `tolman experiment`, built in release.

use std::ffi::OsString;
use std::process::{Command, ExitCode};

use crate::workspace;

/// Runs `tolman experiment` with these arguments in the caller's folder, and returns its exit code.
pub(crate) fn run(arguments: &[OsString]) -> ExitCode {
    let status = Command::new(workspace::cargo_program())
        .args(["run", "--release", "--package", "tolman", "--manifest-path"])
        .arg(workspace::root().join("Cargo.toml"))
        .args(["--", "experiment"])
        .args(arguments)
        .status();
    match status {
        // Without a code, a signal ended it, which is a failure.
        Ok(status) => status.code().map_or(ExitCode::FAILURE, exit_code),
        Err(error) => {
            eprintln!("error: cannot start cargo: {error}");
            ExitCode::FAILURE
        }
    }
}

fn exit_code(code: i32) -> ExitCode {
    u8::try_from(code).map_or(ExitCode::FAILURE, ExitCode::from)
}
