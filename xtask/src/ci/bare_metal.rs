//! Checks that the crates that claim to be `no_std` build where there is no standard library.

use std::path::Path;

use anyhow::{Result, ensure};

use super::Outcome;
use crate::layers::{self, Library};
use crate::workspace::{cargo, output, read, root, succeed};

/// A Cortex-M4F with 64-bit floats in software: the boards of small robots.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Builds every `no_std` crate of the layer table for [`TARGET`], default features off. Without
/// that target it builds them for this machine and looks for `std` among their dependencies'
/// features, which proves less.
pub(super) fn check() -> Result<Outcome> {
    let page = layers::read_page()?;
    let claims = page
        .crates
        .iter()
        .filter(|row| row.library == Library::NoStd);
    let names: Vec<_> = claims.map(|row| row.name.as_str()).collect();
    let target_installed = target_installed()?;
    for name in &names {
        if target_installed {
            succeed(&mut cargo(&format!(
                "build --quiet --package {name} --no-default-features --target {TARGET}"
            )))?;
        } else {
            check_on_host(name)?;
        }
    }
    Ok(if target_installed {
        eprintln!("{} build for {TARGET}", names.join(", "));
        Outcome::Passed
    } else {
        Outcome::Skipped(format!("checked on the host only: {}", missing_target()))
    })
}

/// Returns what to do about the missing target.
pub(crate) fn missing_target() -> String {
    format!("rustup target add {TARGET}")
}

/// Returns whether programs for the target can be built.
pub(crate) fn target_installed() -> Result<bool> {
    let mut rustc = std::process::Command::new("rustc");
    let folder = output(rustc.args(["--print", "target-libdir", "--target", TARGET]))?;
    Ok(Path::new(folder.trim()).is_dir())
}

fn check_on_host(name: &str) -> Result<()> {
    succeed(&mut cargo(&format!(
        "build --quiet --package {name} --no-default-features"
    )))?;
    let folder = name.strip_prefix("tolman-").unwrap_or(name);
    let library = root().join("crates").join(folder).join("src/lib.rs");
    ensure!(
        read(&library)?.contains("#![no_std]"),
        "{} lacks #![no_std]",
        library.display()
    );
    let tree = output(
        cargo(&format!(
            "tree --package {name} --no-default-features --edges normal,no-proc-macro --prefix none"
        ))
        .args(["--format", "{p}\t{f}"]),
    )?;
    for line in tree.lines() {
        let (package, features) = line.split_once('\t').unwrap_or((line, ""));
        ensure!(
            !features.split(',').any(|feature| feature == "std"),
            "{name} switches on std in {package}"
        );
    }
    Ok(())
}
