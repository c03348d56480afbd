//! Checks that the crates that claim to be `no_std` compile where there is no standard library.

use std::fs;
use std::process::Command;

use anyhow::Result;

use super::Outcome;
use crate::layers::{self, Library};
use crate::workspace::{cargo, output, succeed};

/// A Cortex-M4F with 64-bit floats in software: the boards of small robots.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Checks every `no_std` crate of the layer table for [`TARGET`], default features off.
pub(super) fn check() -> Result<Outcome> {
    with_target(|| {
        let page = layers::read_page()?;
        let claims = page
            .crates
            .iter()
            .filter(|row| row.library == Library::NoStd);
        let names: Vec<_> = claims.map(|row| row.name.as_str()).collect();
        for name in &names {
            // Checked together, they would switch on each other's features.
            succeed(&mut cargo(&format!(
                "check --quiet --package {name} --no-default-features --target {TARGET}"
            )))?;
        }
        eprintln!("{} compile for {TARGET}", names.join(", "));
        Ok(Outcome::Passed)
    })
}

/// Runs a step that compiles for [`TARGET`].
pub(crate) fn with_target(step: impl Fn() -> Result<Outcome>) -> Result<Outcome> {
    let mut rustc = Command::new("rustc");
    let folder = output(rustc.args(["--print", "target-libdir", "--target", TARGET]))?;
    if fs::exists(folder.trim())? {
        return step();
    }
    let how = format!("the target is missing: rustup target add {TARGET}");
    Ok(Outcome::Missing(how))
}
