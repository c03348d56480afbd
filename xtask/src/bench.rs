//! `cargo xtask bench`: measures speed. It reports figures and never fails because of them.

use anyhow::Result;

use crate::workspace::{cargo, succeed};

/// Runs the criterion bench `name`, or all of them and then the long ray fuzz.
///
/// # Errors
/// If a bench does not build or the fuzz finds a leak.
pub(crate) fn run(name: Option<&str>) -> Result<()> {
    succeed(cargo("bench --workspace --bench").arg(name.unwrap_or("*")))?;
    if name.is_none() {
        succeed(&mut cargo(
            "test --release --package tolman-sim --test it -- --ignored --nocapture",
        ))?;
    }
    eprintln!("Figures worth keeping go to docs/performance.md, with the machine they came from.");
    Ok(())
}
