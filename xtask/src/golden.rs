//! `cargo xtask golden`: a few runs of every experiment give the values that are committed, to the bit.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::workspace::{self, cargo, succeed};

/// The experiments whose runs are pinned, and the runs of each row.
const PINNED: &[(&str, u32)] = &[
    ("baselines", 5),
    ("quantizers", 3),
    ("mslst", 5),
    ("mslst-sweeps", 1),
    ("micromouse", 1),
    ("diktiometry", 1),
    ("cpm", 1),
    ("gngslam", 1),
];

/// Plays the runs and compares them with those in `tests/golden`; `bless` puts them there instead.
///
/// They are made without the data of others, which are not everywhere.
///
/// # Errors
/// If an experiment fails or a value is another.
pub(crate) fn run(bless: bool) -> Result<()> {
    succeed(&mut cargo("build --release --quiet --package tolman"))?;
    let target = workspace::target_folder()?;
    let tolman = || Command::new(target.join("release").join("tolman"));
    let mut moved = Vec::new();
    for (name, runs) in PINNED {
        let made = target.join("golden").join(name);
        if made.exists() {
            fs::remove_dir_all(&made)
                .with_context(|| format!("cannot empty {}", made.display()))?;
        }
        workspace::output(
            tolman()
                .env("TOLMAN_DATA", made.join("nowhere"))
                .args(["experiment", name, "--runs", &runs.to_string(), "--out"])
                .arg(&made),
        )?;
        let pinned = pinned(name);
        if bless {
            fs::create_dir_all(&pinned)?;
            fs::copy(made.join("runs.jsonl"), pinned.join("runs.jsonl"))?;
            continue;
        }
        let mut compare = tolman();
        compare
            .args(["experiment", "--compare"])
            .arg(pinned)
            .arg(made);
        if succeed(&mut compare).is_err() {
            moved.push(*name);
        }
    }
    ensure!(
        moved.is_empty(),
        "{} gives other values than tests/golden; if that is meant, `cargo xtask golden --bless` in a commit of its own",
        moved.join(", ")
    );
    Ok(())
}

/// The folder of an experiment's committed runs.
fn pinned(name: &str) -> PathBuf {
    workspace::root().join("tests").join("golden").join(name)
}
