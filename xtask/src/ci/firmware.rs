//! Checks that the compiled firmware calls neither std nor an allocator, and cannot panic.

use std::process::Command;

use anyhow::{Result, ensure};
use serde_json::Value;

use super::Outcome;
use crate::workspace::{cargo, output};

/// Name of the package that combines the `no_std` crates.
const FIRMWARE: &str = "tolman-firmware";

/// Names that must not be called, as `nm` writes them.
const BANNED: [&str; 6] = [
    "core::panicking",
    "core::option::",
    "core::result::",
    "std::",
    "alloc::",
    "__rust_alloc",
];

/// Builds the firmware for this machine, optimized, and checks the undefined symbols of it and of
/// the project's crates below it.
pub(super) fn check() -> Result<Outcome> {
    // With link-time optimization the libraries would not hold machine code yet.
    let messages = output(
        cargo("build --quiet --release --message-format json --no-default-features --package")
            .arg(FIRMWARE)
            .args(["--config", "profile.release.lto=false"]),
    )?;
    let libraries: Vec<String> = messages.lines().flat_map(own_libraries).collect();
    ensure!(!libraries.is_empty(), "{FIRMWARE} was built from nothing");
    for library in &libraries {
        let names = output(Command::new("nm").args(["--demangle", "--undefined-only", library]))?;
        for name in names.lines() {
            ensure!(
                !BANNED.iter().any(|banned| name.contains(banned)),
                "{library} refers to {}: find out which function does (nm, objdump), and do without",
                name.trim()
            );
        }
    }
    eprintln!(
        "{} libraries need no std, no alloc and never panic",
        libraries.len()
    );
    Ok(Outcome::Passed)
}

/// Returns the project's own libraries that a message of cargo names as built.
fn own_libraries(message: &str) -> Vec<String> {
    let Ok(message) = serde_json::from_str::<Value>(message) else {
        return Vec::new();
    };
    let own = message["target"]["name"]
        .as_str()
        .is_some_and(|name| name.starts_with("tolman"));
    let files = message["filenames"].as_array().filter(|_| own);
    let names = files.into_iter().flatten().filter_map(Value::as_str);
    names
        .filter(|name| name.ends_with(".rlib"))
        .map(str::to_owned)
        .collect()
}
