//! `cargo xtask golden`: a few runs of every experiment give the values that are committed, to the
//! bit.

use alloc::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::workspace::{self, cargo, succeed};

/// An experiment whose runs are pinned, the runs of each row (none: those of `--quick`), and the
/// tables of which there are more.
type Pinned = (&'static str, u32, &'static [(u32, &'static str)]);

/// The rows that an experiment has for a first look: the slowest are left out.
const QUICK: u32 = 0;

const PINNED: &[Pinned] = &[
    ("baselines", 5, &[]),
    ("quantizers", 3, &[]),
    ("mslst", 5, &[]),
    ("mslst-drawings", 2, &[]),
    ("mslst-sweeps", 1, &[]),
    ("micromouse", 1, &[(2, "noise")]),
    ("diktiometry", 1, &[]),
    (
        "cpm",
        1,
        &[(10, "explored"), (50, "aliased"), (25, "localization")],
    ),
    ("gngslam", 1, &[(10, "guesses")]),
    ("arena", QUICK, &[]),
];

/// Of experiments with too many runs the tables that are pinned; of all others all are.
const TABLES: &[(&str, &[&str])] = &[(
    "arena",
    &[
        "learn, Pioneer",
        "home, Pioneer",
        "locate, Pioneer",
        "conditions",
    ],
)];

/// Plays the runs of these experiments, or of all, and compares them with those in `tests/golden`;
/// `bless` puts them there instead.
///
/// They are made without the data of others, which are not everywhere.
///
/// # Errors
/// If there is no such experiment, one fails or a value is another.
pub(crate) fn run(names: &[String], bless: bool) -> Result<()> {
    let known: Vec<&str> = PINNED.iter().map(|pinned| pinned.0).collect();
    for name in names {
        ensure!(
            known.contains(&name.as_str()),
            "no runs of `{name}` are pinned: give one of {}",
            known.join(", ")
        );
    }
    succeed(&mut cargo("build --release --quiet --package tolman"))?;
    let is_asked_for = |name: &str| names.is_empty() || names.iter().any(|one| one == name);
    run_those(is_asked_for, bless, "release")
}

/// What takes longest, and is left to `cargo xtask golden` by hand.
const SLOW: &[&str] = &["mslst", "mslst-sweeps", "diktiometry", "gngslam"];

/// Compares all but the slowest, with the command that the tests have built.
///
/// # Errors
/// If an experiment fails or a value is another.
pub(crate) fn run_quick() -> Result<()> {
    run_those(|name| !SLOW.contains(&name), false, "debug")
}

fn run_those(is_asked_for: impl Fn(&str) -> bool, bless: bool, profile: &str) -> Result<()> {
    let target = workspace::target_folder()?;
    let tolman = || Command::new(target.join(profile).join("tolman"));
    let mut moved = Vec::new();
    for (name, runs, more) in PINNED.iter().filter(|pinned| is_asked_for(pinned.0)) {
        let made = target.join("golden").join(name);
        if made.exists() {
            fs::remove_dir_all(&made)
                .with_context(|| format!("cannot empty {}", made.display()))?;
        }
        let play = |runs: u32, tables: &[&str]| {
            let count = match runs {
                QUICK => vec!["--quick".to_owned()],
                runs => vec!["--runs".to_owned(), runs.to_string()],
            };
            workspace::output(
                tolman()
                    .env("TOLMAN_DATA", made.join("nowhere"))
                    .args(["experiment", name])
                    .args(count)
                    .arg("--out")
                    .arg(&made)
                    .args(tables.iter().flat_map(|table| ["--table", table])),
            )
        };
        let tables = TABLES.iter().find(|(of, _)| of == name);
        play(*runs, tables.map_or(&[], |(_, tables)| tables))?;
        let file = made.join("runs.jsonl");
        let mut all = fs::read_to_string(&file)?;
        for (runs, table) in *more {
            play(*runs, &[table])?;
            // A table alone leaves the runs of the others aside; its first are there already.
            let lines: BTreeSet<String> = all.lines().map(str::to_owned).collect();
            for line in fs::read_to_string(&file)?.lines() {
                if !lines.contains(line) {
                    all += &format!("{line}\n");
                }
            }
        }
        fs::write(&file, all)?;
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
