//! The runs of an experiment, line by line, as they were when they were last looked at. Debug or
//! release, one thread or many, today or next year: the lines stay the same.

use std::fs;
use std::path::Path;

use tolman_experiment::{Build, Options, Silent, execute, open};

use crate::support::root;

const GOLDEN: &str = "it/golden/runs.jsonl";

/// The lines of `runs.jsonl` of a few runs of the baselines on the project's own mazes.
fn runs(jobs: u32) -> String {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("golden-{jobs}"));
    let options = Options {
        seed: 1,
        runs: Some(3),
        jobs: Some(jobs),
        mazes: ["j.maze", "large.maze"]
            .map(|name| root().join("mazes").join(name))
            .into(),
        out: Some(out.clone()),
        ..Options::default()
    };
    let experiment = open(tolman_papers::catalogue(), "baselines", &options).unwrap();
    if out.exists() {
        fs::remove_dir_all(&out).unwrap();
    }
    execute(
        &experiment,
        &options,
        &Build::current("unknown", "unknown"),
        &Silent,
    )
    .unwrap();
    fs::read_to_string(out.join("runs.jsonl")).unwrap()
}

#[test]
fn the_runs_are_the_golden_ones_on_any_number_of_threads() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join(GOLDEN);
    if std::env::var_os("BLESS").is_some() {
        fs::write(&golden, runs(1)).unwrap();
    }
    let expected = fs::read_to_string(&golden).unwrap();
    for jobs in [1, 2] {
        let runs = runs(jobs);
        for (number, (run, expected)) in (1..).zip(runs.lines().zip(expected.lines())) {
            // Values count, and not the checksum behind them.
            let (values, _) = run.split_once(",\"checksum\"").unwrap();
            assert_eq!(
                format!("{values}}}"),
                expected,
                "line {number} of {GOLDEN}, {jobs} jobs; if the change is meant, look at what it does \
                 to the tables and set BLESS=1"
            );
        }
        assert_eq!(runs.lines().count(), expected.lines().count());
    }
}
