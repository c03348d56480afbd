//! Checks the `rust-version` of the manifest.

use std::process::Command;

use anyhow::{Context, Result};

use super::Outcome;
use crate::workspace::{metadata, output, root, succeed};

/// Passes if this run's rustc is the stated one. Otherwise builds with the stated one if rustup has
/// it.
pub(super) fn check() -> Result<Outcome> {
    let stated = stated()?;
    let here = output(Command::new("rustc").arg("--version"))?;
    let here = here
        .split_whitespace()
        .nth(1)
        .context("`rustc --version` names no version")?;
    if is_of(here, &stated) {
        eprintln!("rust-version = \"{stated}\" and this is rustc {here}");
        return Ok(Outcome::Passed);
    }
    let toolchains = output(Command::new("rustup").args(["toolchain", "list"])).unwrap_or_default();
    let Some(toolchain) = toolchains.split_whitespace().find(|name| {
        name.split('-')
            .next()
            .is_some_and(|version| is_of(version, &stated))
    }) else {
        return Ok(Outcome::Missing(format!(
            "rust-version = \"{stated}\", this is rustc {here}: rustup toolchain add {stated}"
        )));
    };
    let mut check = Command::new("rustup");
    check.current_dir(root()).args([
        "run",
        toolchain,
        "cargo",
        "check",
        "--workspace",
        "--target-dir",
        "target/msrv",
    ]);
    succeed(&mut check)?;
    Ok(Outcome::Passed)
}

/// Returns the `rust-version` that all members inherit.
fn stated() -> Result<String> {
    let metadata = metadata()?;
    let version = metadata["packages"][0]["rust_version"].as_str();
    Ok(version.context("no rust-version is stated")?.to_owned())
}

/// Returns whether `version` is a release of `series`: 1.95.1 is one of 1.95.
fn is_of(version: &str, series: &str) -> bool {
    version
        .strip_prefix(series)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}
