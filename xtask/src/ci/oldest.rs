//! Lints and documents the code with the compiler that the manifest's `rust-version` states.
//!
//! So one pass over the code shows that it has no lints and that this compiler suffices. The tests
//! run with the present one.

use std::process::Command;

use anyhow::{Context, Result};

use super::{Outcome, passed};
use crate::workspace::{self, metadata, output, root, succeed};

/// Lints everything, with the present compiler if the stated one is not there.
pub(super) fn lints() -> Result<Outcome> {
    passed(succeed(&mut cargo(
        "clippy --workspace --all-features --all-targets --quiet -- --deny warnings",
    )?))
}

/// Passes if the stated compiler is there and takes the whole code.
pub(super) fn suffices() -> Result<Outcome> {
    let stated = stated()?;
    if toolchain(&stated)?.is_none() && !is_of(&present()?, &stated) {
        return Ok(Outcome::Missing(format!(
            "rust-version = \"{stated}\", this is rustc {}: rustup toolchain add {stated} --component clippy",
            present()?
        )));
    }
    lints()
}

/// Returns the stated compiler's cargo with these arguments, separated by spaces, and a folder of
/// its own; the present cargo if it is the stated one or that is not there.
pub(super) fn cargo(arguments: &str) -> Result<Command> {
    let Some(toolchain) = toolchain(&stated()?)? else {
        return Ok(workspace::cargo(arguments));
    };
    let mut command = Command::new("rustup");
    command
        .current_dir(root())
        .args(["run", &toolchain, "cargo"])
        .args(arguments.split_whitespace())
        .env(
            "CARGO_TARGET_DIR",
            workspace::target_folder()?.join("oldest"),
        );
    Ok(command)
}

/// Returns rustup's name of the stated compiler, if it has it, and the present one is another.
fn toolchain(stated: &str) -> Result<Option<String>> {
    if is_of(&present()?, stated) {
        return Ok(None);
    }
    let toolchains = output(Command::new("rustup").args(["toolchain", "list"])).unwrap_or_default();
    let mut names = toolchains
        .split_whitespace()
        .filter(|name| is_of(name.split('-').next().unwrap_or(name), stated));
    Ok(names.next().map(str::to_owned))
}

/// Returns the version of the compiler that runs.
fn present() -> Result<String> {
    let here = output(Command::new("rustc").arg("--version"))?;
    let version = here.split_whitespace().nth(1);
    Ok(version
        .context("`rustc --version` names no version")?
        .to_owned())
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
