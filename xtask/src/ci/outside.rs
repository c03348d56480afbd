//! Checks that a user's program, `tests/outside`, builds against the workspace and works.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Result, ensure};

use crate::workspace;

/// Commit that the program is told it was built from.
const COMMIT: &str = "0123abcd";

/// Builds the program, and lets it draw a world, learn it and run an experiment.
///
/// # Errors
/// If it does not build, one of its commands fails, or its report names another program or commit.
pub(crate) fn check() -> Result<()> {
    let folder = workspace::root().join("tests/outside");
    let target = workspace::target_folder()?;
    for file in [
        "main",
        "system",
        "robot",
        "tank_entry",
        "world",
        "experiment",
    ] {
        let source = folder.join("src").join(file).with_extension("rs");
        let lines = fs::read_to_string(&source)?.lines().count();
        ensure!(
            lines <= 60,
            "{}: {lines} lines, and 60 are to suffice",
            source.display()
        );
    }
    let mut build = Command::new(env!("CARGO"));
    build.current_dir(&folder).env("OUTSIDE_COMMIT", COMMIT);
    build
        .args(["build", "--locked", "--quiet", "--target-dir"])
        .arg(&target);
    workspace::succeed(&mut build)?;
    let work = target.join("tmp/outside");
    if work.exists() {
        fs::remove_dir_all(&work)?;
    }
    fs::create_dir_all(&work)?;
    for line in [
        "maze generate teeth --size 5x4 --seed 2 --out teeth.maze",
        "learn --system paces --maze teeth.maze --out paces.json",
        "map show paces.json",
        "learn --system paces-of-a-tank --maze teeth.maze --out tank.json --trace tank.jsonl --replay tank.html",
        "experiment combs --quick --out combs",
    ] {
        let mut command = Command::new(target.join("debug/outside"));
        command.current_dir(&work).args(line.split(' '));
        // As a user calls it, not through Cargo.
        command.env_remove("CARGO");
        workspace::succeed(&mut command)?;
    }
    names_itself(&work.join("combs/config.toml"))
}

/// Checks which program and commit made a folder of results.
fn names_itself(config: &Path) -> Result<()> {
    let text = fs::read_to_string(config)?;
    for part in [
        "command = \"outside experiment combs",
        &format!("commit = \"{COMMIT}\""),
    ] {
        ensure!(text.contains(part), "no `{part}` in {}", config.display());
    }
    Ok(())
}
