//! Checks that the crates that claim to be `no_std` compile where there is no standard library.

use std::process::Command;

use anyhow::Result;

use super::Outcome;
use crate::layers::{self, Library};
use crate::workspace::{cargo, output, root, succeed};

/// A Cortex-M4F with 64-bit floats in software: the boards of small robots.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Says how to install a compiler for [`TARGET`].
pub(crate) const HOW: &str = "no compiler for the chip: rustup target add thumbv7em-none-eabihf, or see .ci/run for one of Debian";

/// A toolchain of rustup by this name has the sources of `core`, and compiles them first.
const WITH_SOURCES: &str = "bare-metal";

/// A compiler for [`TARGET`].
#[derive(Clone, Copy)]
pub(crate) enum Compiler {
    /// The usual one, which has `core` for the target.
    Usual,
    /// The one of [`WITH_SOURCES`].
    WithSources,
}

impl Compiler {
    /// Returns the compiler to use, `None` if there is none.
    pub(crate) fn found() -> Result<Option<Self>> {
        let mut rustc = Command::new("rustc");
        let folder = output(rustc.args(["--print", "target-libdir", "--target", TARGET]))?;
        if std::fs::exists(folder.trim())? {
            return Ok(Some(Self::Usual));
        }
        let probe = Command::new("rustup")
            .args(["run", WITH_SOURCES, "rustc", "--version"])
            .output();
        let found = probe.is_ok_and(|probe| probe.status.success());
        Ok(found.then_some(Self::WithSources))
    }

    /// Returns a call of its cargo in the workspace's root.
    pub(crate) fn cargo(self, arguments: &str) -> Command {
        match self {
            Self::Usual => cargo(arguments),
            Self::WithSources => {
                let mut command = Command::new("rustup");
                command
                    .args(["run", WITH_SOURCES, "cargo"])
                    .args(arguments.split_whitespace())
                    .arg("-Zbuild-std=core,alloc")
                    .env("RUSTC_BOOTSTRAP", "1")
                    .current_dir(root());
                command
            }
        }
    }
}

/// Checks every `no_std` crate of the layer table for [`TARGET`], default features off.
pub(super) fn check() -> Result<Outcome> {
    let Some(compiler) = Compiler::found()? else {
        return Ok(Outcome::Missing(HOW.to_owned()));
    };
    let page = layers::read_page()?;
    let claims = page
        .crates
        .iter()
        .filter(|row| row.library == Library::NoStd);
    let names: Vec<_> = claims.map(|row| row.name.as_str()).collect();
    for name in &names {
        // Checked together, they would switch on each other's features.
        succeed(&mut compiler.cargo(&format!(
            "check --quiet --package {name} --no-default-features --target {TARGET}"
        )))?;
    }
    eprintln!("{} compile for {TARGET}", names.join(", "));
    Ok(Outcome::Passed)
}
