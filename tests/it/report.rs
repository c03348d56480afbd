//! The report of an experiment on the project's mazes.

use std::fs;
use std::path::{Path, PathBuf};

use tolman_experiment::{
    Build, ExperimentOutcome, Ink, Options, Silent, execute, open, tables_as_text,
};

use crate::support::root;

/// A few runs of the baselines in these mazes, with their results in an empty folder of this name.
fn baselines(name: &str, runs: u32, mazes: Vec<PathBuf>) -> ExperimentOutcome {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(name)
        .join("out");
    if out.exists() {
        fs::remove_dir_all(&out).unwrap();
    }
    let options = Options {
        seed: 7,
        runs: Some(runs),
        jobs: Some(2),
        mazes,
        out: Some(out),
        ..Options::default()
    };
    let experiment = open(tolman_papers::catalogue(), "baselines", &options).unwrap();
    execute(
        &experiment,
        &options,
        &Build::current("unknown", "unknown"),
        &Silent,
    )
    .unwrap()
}

/// 25 runs of each of 8 rows, told from 2 runs: a page grows by no more than its runs.
#[test]
fn the_report_of_two_mazes_stays_below_five_megabytes() {
    let mazes = ["j.maze", "large.maze"].map(|name| root().join("mazes").join(name));
    let outcome = baselines("page-size", 2, mazes.to_vec());
    assert_eq!(outcome.replays.recorded.len(), 2 * 8);
    let size = fs::read(outcome.folder.join("report.html")).unwrap().len();
    assert!(size * 25 / 2 < 5_000_000, "{size}");
}

#[cfg(unix)]
#[test]
fn control_characters_in_the_name_of_a_maze_file_reach_nothing() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("escape");
    fs::create_dir_all(&folder).unwrap();
    let maze = folder.join("\u{1b}[31mred.maze");
    let text = fs::read_to_string(root().join("mazes/j.maze")).unwrap();
    let nameless = text.lines().filter(|line| !line.starts_with("name"));
    fs::write(&maze, nameless.collect::<Vec<_>>().join("\n")).unwrap();
    let outcome = baselines("escape", 1, vec![maze]);
    assert_eq!(outcome.runs[0].table, "\u{fffd}[31mred");
    let read = |name: &str| fs::read_to_string(outcome.folder.join(name)).unwrap();
    for text in [
        tables_as_text(&outcome.analysis, Ink::Plain),
        read("report.html"),
        read("config.toml"),
        outcome.command.clone(),
    ] {
        assert!(!text.contains('\u{1b}'));
    }
}
