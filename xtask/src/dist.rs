//! `cargo xtask dist`: builds one file that runs on every Linux of this processor.

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;
use std::{env, fs};

use anyhow::{Context, Result, ensure};

use crate::workspace::{cargo, output, succeed, target_folder};

/// Number of times that the start is measured; the fastest counts.
const STARTS: u32 = 20;

/// Returns the name of the target for static linking.
///
/// # Errors
/// If it is not installed.
pub(crate) fn target() -> Result<String> {
    let target = format!("{}-unknown-linux-musl", env::consts::ARCH);
    let installed =
        output(Command::new("rustc").args(["--print", "target-libdir", "--target", &target]))?;
    ensure!(
        fs::exists(installed.trim())?,
        "the target is missing: rustup target add {target}"
    );
    Ok(target)
}

/// Builds the command with all its Rust features, linked statically, prints its size and how long
/// it takes to start, and returns its path.
///
/// # Errors
/// If the target for static linking is not installed, or the command does not build or run.
pub(crate) fn run() -> Result<PathBuf> {
    let target = target()?;
    succeed(cargo("build --release --package tolman --features live --target").arg(&target))?;
    let folder = target_folder()?;
    let made = folder.join(&target).join("release/tolman");
    let dist = folder.join("dist");
    fs::create_dir_all(&dist)?;
    let file = dist.join(format!("tolman-{target}"));
    fs::copy(&made, &file).with_context(|| format!("cannot copy {}", made.display()))?;
    let mut fastest = f64::INFINITY;
    for _ in 0..STARTS {
        let began = Instant::now();
        output(Command::new(&file).arg("--version"))?;
        fastest = fastest.min(began.elapsed().as_secs_f64());
    }
    let megabytes = fs::metadata(&file)?.len() as f64 / 1e6;
    eprintln!(
        "{}: {megabytes:.1} MB, starts in {:.1} ms",
        file.display(),
        1e3 * fastest
    );
    Ok(file)
}
