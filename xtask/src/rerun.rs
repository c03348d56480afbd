//! `cargo xtask rerun`: tests the package that writes replays for Rerun, which is no member of the
//! workspace.

use std::process::Command;

use anyhow::Result;

use crate::ci::Outcome;
use crate::workspace::{cargo, succeed, target_folder};

/// Manifest of the package.
const MANIFEST: &str = "crates/rerun/Cargo.toml";

/// Checks the package's form, lints it and tests it, if its crates are present or can be fetched.
///
/// # Errors
/// If it is not formatted, does not build or fails a test.
pub(crate) fn check() -> Result<Outcome> {
    if succeed(&mut here("fetch --locked --quiet")).is_err() {
        let why = "the crates it needs cannot be fetched";
        return Ok(Outcome::Missing(why.to_owned()));
    }
    succeed(here("fmt").args(["--", "--check"]))?;
    let mut lints = here("clippy --locked --quiet --all-targets --target-dir");
    lints
        .arg(target_folder()?)
        .args(["--", "--deny", "warnings"]);
    succeed(&mut lints)?;
    let mut tests = here("test --locked --quiet --target-dir");
    succeed(tests.arg(target_folder()?))?;
    Ok(Outcome::Passed)
}

/// Returns a subcommand of cargo, with its arguments, for the package.
fn here(arguments: &str) -> Command {
    let (subcommand, rest) = arguments.split_once(' ').unwrap_or((arguments, ""));
    let mut command = cargo(&format!("{subcommand} --manifest-path {MANIFEST}"));
    command.args(rest.split_whitespace());
    command
}
