//! `cargo xtask golden`: plays a few runs of every experiment, and compares their values, to the
//! bit, with the committed ones.

use alloc::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::workspace::{self, cargo, succeed};

/// An experiment with committed runs, the number of runs of each row (0: those of `--quick`), and
/// the tables that have another number.
type Pinned = (&'static str, u32, &'static [(u32, &'static str)]);

/// Number that stands for the rows and runs of `--quick`, which leaves out the slowest rows.
const QUICK: u32 = 0;

const PINNED: &[Pinned] = &[
    ("baselines", 5, &[]),
    ("quantizers", 1, &[]),
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
    ("tolman", 1, &[]),
];

/// Tables that are compared, for experiments with too many runs. Of all others, every table is.
const TABLES: &[(&str, &[&str])] = &[(
    "arena",
    &[
        "learn, Pioneer",
        "home, Pioneer",
        "locate, Pioneer",
        "conditions",
    ],
)];

/// Tables that are compared with every change, where all take too long for it: a robot that goes
/// home has learned before. Of tables that have another number of runs, every change plays as many
/// as of the others.
const QUICK_TABLES: &[(&str, &[&str])] = &[("arena", &["home, Pioneer"])];

/// Plays the runs of these experiments, or of all if none is named, and compares them with those in
/// `tests/golden`. With `bless` it writes them there instead.
///
/// External data sets are not used, because not every machine has them.
///
/// # Errors
/// If there is no such experiment, one fails, or a value differs.
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
    run_those(is_asked_for, TABLES, Extent::Whole { bless })
}

/// The slowest experiments, which only `cargo xtask golden` plays.
const SLOW: &[&str] = &["mslst", "mslst-sweeps", "diktiometry", "gngslam", "tolman"];

/// Compares all experiments but the slowest, with the command that the tests have built.
///
/// # Errors
/// If an experiment fails or a value differs.
pub(crate) fn run_quick() -> Result<()> {
    run_those(|name| !SLOW.contains(&name), QUICK_TABLES, Extent::Quick)
}

/// How much is played.
#[derive(Clone, Copy)]
enum Extent {
    /// With every change, by the command that the tests have built.
    Quick,
    /// All pinned runs, by the optimized command; with `bless` they are written.
    Whole { bless: bool },
}

fn run_those(
    is_asked_for: impl Fn(&str) -> bool,
    tables: &[(&str, &[&str])],
    extent: Extent,
) -> Result<()> {
    let target = workspace::target_folder()?;
    let (profile, is_whole, bless) = match extent {
        Extent::Quick => ("debug", false, false),
        Extent::Whole { bless } => ("release", true, bless),
    };
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
        let tables = tables.iter().find(|(of, _)| of == name);
        let tables = tables.map_or(&[][..], |(_, tables)| *tables);
        play(*runs, tables)?;
        let file = made.join("runs.jsonl");
        let mut all = fs::read_to_string(&file)?;
        for (runs, table) in more.iter().filter(|_| is_whole) {
            play(*runs, &[table])?;
            // A run of one table leaves the runs of the others alone; the first ones are already
            // there.
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
        let is_played = |table: &str, run: u64| {
            let is_of_tables = tables.is_empty() || tables.contains(&table);
            let is_further =
                more.iter().any(|further| further.1 == table) && run >= u64::from(*runs);
            is_of_tables && (is_whole || !is_further)
        };
        let mut compare = tolman();
        compare
            .args(["experiment", "--compare"])
            .arg(part_of(&pinned, &is_played, &target)?)
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

/// Returns a folder with those committed runs, named by table and number, that were played.
fn part_of(pinned: &Path, is_played: &dyn Fn(&str, u64) -> bool, target: &Path) -> Result<PathBuf> {
    let mut kept = String::new();
    for line in fs::read_to_string(pinned.join("runs.jsonl"))?.lines() {
        let run: Value = serde_json::from_str(line)?;
        let table = run["table"].as_str().context("a pinned run has no table")?;
        let number = run["run"].as_u64().context("a pinned run has no number")?;
        if is_played(table, number) {
            kept += &format!("{line}\n");
        }
    }
    let folder = target.join("tmp").join("pinned");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("runs.jsonl"), kept)?;
    Ok(folder)
}

/// Returns the folder of an experiment's committed runs.
fn pinned(name: &str) -> PathBuf {
    workspace::root().join("tests").join("golden").join(name)
}
