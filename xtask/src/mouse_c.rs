//! `cargo xtask c`: compares the header of the mouse for C with its code, and lets programs in C
//! explore mazes. The package is no member of the workspace.

use std::fs;
use std::process::Command;

use anyhow::{Result, ensure};

use crate::ci::{Outcome, with};
use crate::workspace::{cargo, output, root, succeed, target_folder};

/// Folder of the package.
const FOLDER: &str = "crates/mouse-c";

/// The header, in the folder of the package.
const HEADER: &str = "include/tolman_mouse.h";

/// Checks the package's form, lints and tests it, and compares its header with what cbindgen
/// writes.
///
/// # Errors
/// If a check fails.
pub(crate) fn check() -> Result<Outcome> {
    succeed(here("fmt")?.args(["--", "--check"]))?;
    succeed(here("clippy --locked --quiet --all-targets")?.args(["--", "--deny", "warnings"]))?;
    succeed(&mut here("test --locked --quiet")?)?;
    succeed(&mut here("check --locked --quiet --features side-32")?)?;
    with("cbindgen", "apt-get install cbindgen", || {
        let mut cbindgen = Command::new("cbindgen");
        cbindgen.current_dir(root().join(FOLDER)).arg("--quiet");
        let header = output(&mut cbindgen)?;
        let kept = fs::read_to_string(root().join(FOLDER).join(HEADER))?;
        ensure!(
            header == kept,
            "{FOLDER}/{HEADER} is not what the code says: run `cbindgen --output {HEADER}` in {FOLDER}"
        );
        Ok(Outcome::Passed)
    })
}

/// Returns a call of cargo in the package's folder.
fn here(arguments: &str) -> Result<Command> {
    let mut command = cargo(arguments);
    command
        .current_dir(root().join(FOLDER))
        .env("CARGO_TARGET_DIR", target_folder()?);
    Ok(command)
}
