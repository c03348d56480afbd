//! Checks that a user's program, `tests/outside`, builds against the workspace and works.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Result, ensure};

use crate::workspace;

/// Commit that the program is told it was built from.
const COMMIT: &str = "0123abcd";

/// Builds the program, and lets its system and its robot work in its worlds, by every verb.
///
/// # Errors
/// If it does not build, one of its commands fails, or its report names another program or commit.
pub(crate) fn check() -> Result<()> {
    let folder = workspace::root().join("tests/outside");
    let target = workspace::target_folder()?;
    for file in ["main", "system", "robot", "world", "experiment"] {
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
    let worlds = folder.join("worlds");
    let drawings = fs::read_dir(&worlds)?.collect::<Result<Vec<_>, _>>()?;
    let work = target.join("tmp/outside");
    if work.exists() {
        fs::remove_dir_all(&work)?;
    }
    fs::create_dir_all(&work)?;
    let command = |line: &str| {
        let mut command = Command::new(target.join("debug/outside"));
        command.current_dir(&work).args(line.split(' '));
        // As a user calls it, not through Cargo.
        command.env_remove("CARGO");
        command
    };
    for line in [
        "maze generate teeth --size 5x4 --seed 2 --out teeth.maze",
        "learn --system paces --maze teeth.maze --out paces.json",
        "map show paces.json",
        "drive --map paces.json --maze teeth.maze --seed 2",
        "learn --system paces --robot tank --maze teeth.maze --out tank.json --trace tank.jsonl --replay tank.html",
        "systems --json",
        "arena --system paces --family all --worlds 1",
        "arena --system mslst-better --robot tank --family teeth --condition doors --worlds 1",
        "experiment combs --quick --out combs",
    ] {
        workspace::succeed(&mut command(line))?;
    }
    let mut arena = command("arena --system paces --json");
    let rows = workspace::output(arena.arg(&worlds))?;
    ensure!(
        rows.lines().count() == drawings.len() && rows.contains("\"abstained\":null"),
        "a row for each of the worlds: {rows}"
    );
    let mapper = command("host --template mapper").output()?.stdout;
    fs::write(work.join("mapper.py"), mapper)?;
    let mut arena = command("arena --family teeth --worlds 1 --json --mapper");
    let row = arena.arg("python3 mapper.py").output()?.stdout;
    let row = String::from_utf8_lossy(&row);
    ensure!(
        row.contains("\"right\":true"),
        "the mapper in Python: {row}"
    );
    // Its system never says where it is.
    let demo = "demo --system paces --maze teeth.maze --out demo.html";
    let mut demo = command(demo);
    let done = demo.output()?;
    ensure!(
        done.status.code() == Some(1),
        "demo ended with {}",
        done.status
    );
    ensure!(work.join("demo.html").is_file(), "demo wrote no replay");
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
