//! `cargo xtask fuzz`: gives mutated files to every reader.

use anyhow::Result;

use crate::workspace::{built, cargo, succeed, target_folder};

/// Mutates the seeds of these targets, or of all, for `seconds` in total. Overflow checks are on.
/// Files that show a fault go to `target/fuzz`.
///
/// # Errors
/// If a reader panics, takes longer than 2 s or holds more than 1 GiB.
pub(crate) fn run(seconds: u64, seed: u64, targets: &[String]) -> Result<()> {
    // The whole workspace is named, so that what the tests have compiled is used.
    succeed(&mut cargo(
        "build --workspace --all-features --bin fuzz --quiet",
    ))?;
    let mut fuzz = built("fuzz")?;
    fuzz.args([seconds.to_string(), seed.to_string()]);
    succeed(fuzz.arg(target_folder()?.join("fuzz")).args(targets))
}
