//! `cargo xtask ci`: runs the steps that a change must pass, times each, and prints a table at the
//! end.

pub(crate) mod bare_metal;
mod firmware;
mod msrv;
mod outside;
mod packages;

use core::time::Duration;
use std::env;
use std::process::Command;
use std::time::Instant;

use anyhow::{Result, anyhow, bail};

use crate::workspace::{self, built, cargo, installed, succeed};
use crate::{board, docs, fuzz, golden, layers, mazes, mutants, playground, prose, python, rerun};

/// Outcome of a step that did not fail.
pub(crate) enum Outcome {
    Passed,
    /// The step did not run, for this reason.
    Skipped(String),
}

type Step = (&'static str, fn() -> Result<Outcome>);

/// The steps of every run, cheap and telling ones first. Lints, tests and docs have all features
/// on, so that no feature is missed and everything is compiled once. The plain build, bare metal
/// and firmware check the builds without features.
const STEPS: &[Step] = &[
    ("format", || passes("fmt --all --check")),
    ("layers", || passed(layers::run())),
    ("prose", || passed(prose::run())),
    ("links", || passed(docs::pages())),
    ("lints", || {
        passes("clippy --workspace --all-features --all-targets --quiet -- --deny warnings")
    }),
    ("tests", tests),
    ("doc tests", || {
        passes("test --workspace --all-features --doc --quiet")
    }),
    // The tests have just built the command.
    ("mazes", || passed(mazes::check_with(|| built("tolman")))),
    // The build of a user, without the features that only the steps above switch on.
    ("plain build", || passes("check --workspace --quiet")),
    // The members of a workspace switch each other's default features on.
    ("no parry2d", || {
        passes(
            "clippy --package tolman-sim --no-default-features --all-targets --quiet -- --deny warnings",
        )
    }),
    ("outside", || passed(outside::check())),
    ("package", || passed(packages::one())),
    ("api docs", || passed(docs::api())),
    ("golden", || passed(golden::run_quick())),
    ("commands", commands),
    ("browser", || {
        if_installed("chromium", || {
            passes("test --workspace --all-features --test browser --quiet -- --ignored")
        })
    }),
    ("bare metal", bare_metal::check),
    ("firmware", firmware::check),
    ("board", board::check),
    ("msrv", msrv::check),
    ("licences", || {
        if_installed("cargo-deny", || {
            passes("deny --all-features check bans licenses sources")
        })
    }),
    ("advisories", || if_installed("cargo-deny", advisories)),
    ("spelling", || {
        if_installed("typos", || passed(succeed(&mut typos())))
    }),
];

/// The steps that take too long for every change.
const THOROUGH: &[Step] = &[
    ("fuzz", fuzz_targets),
    ("fuzzing", || passed(fuzz::run(FUZZING, 1, &[]))),
    // Programs that are killed, or misbehave, again and again.
    ("endurance", || {
        passes(
            "test --workspace --all-features --test cli --quiet -- --ignored a_thousand a_hundred",
        )
    }),
    ("mutants", || mutants::check(MUTANTS, &[])),
    ("golden, all", || passed(golden::run(&[], false))),
    ("pages", || if_installed("chromium", all_pages)),
    ("python", python::check),
    ("rerun", rerun::check),
    ("playground", playground::check),
    ("packages", || passed(packages::all())),
    // Every set of a crate's features by itself: the other steps turn on all of them or none.
    ("features", || {
        if_installed("cargo-hack", || {
            passes(
                "hack clippy --workspace --feature-powerset --exclude-features default --quiet -- --deny warnings",
            )
        })
    }),
];

/// Some thirty changes of the code, spread over all crates that are changed.
const MUTANTS: mutants::Shard = mutants::Shard { first: 0, of: 400 };

/// Duration of fuzzing all readers, seconds.
const FUZZING: u64 = 600;

/// Runs all steps, with `thorough` also the long ones; or those of these names, if there are any.
/// The first failure ends the run unless `keep_going`. After the tests, steps that have not begun
/// within `minutes` are left out: a slow machine still tells of the most important ones in time.
///
/// # Errors
/// If a step failed, or has no such name.
pub(crate) fn run(
    keep_going: bool,
    thorough: bool,
    minutes: Option<u64>,
    names: &[String],
) -> Result<()> {
    let start = Instant::now();
    let mut table: Vec<(&str, Duration, String)> = Vec::new();
    let mut failures = 0;
    let steps = chosen(thorough, names)?;
    for (name, step) in &steps {
        eprintln!("\n== {name}");
        let begun = Instant::now();
        let were_tested = table.iter().any(|(name, ..)| *name == "tests");
        let is_over = |minutes: &u64| start.elapsed().as_secs() / 60 >= *minutes;
        let result = match minutes.filter(is_over) {
            Some(minutes) if were_tested => {
                Ok(Outcome::Skipped(format!("{minutes} minutes are over")))
            }
            _ => step(),
        };
        let verdict = match result {
            Ok(Outcome::Passed) => "ok".to_owned(),
            Ok(Outcome::Skipped(why)) => format!("skipped: {why}"),
            Err(error) => {
                eprintln!("error: {error:#}");
                failures += 1;
                "FAILED".to_owned()
            }
        };
        table.push((*name, begun.elapsed(), verdict));
        if failures > 0 && !keep_going {
            break;
        }
    }
    print_table(&table, start.elapsed());
    let not_run = steps.len() - table.len();
    match (failures, not_run) {
        (0, _) => Ok(()),
        (_, 0) => bail!("{failures} of {} steps failed", steps.len()),
        _ => bail!("a step failed, {not_run} more were not run (--keep-going runs them)"),
    }
}

/// Returns the steps to run.
fn chosen(thorough: bool, names: &[String]) -> Result<Vec<&'static Step>> {
    if names.is_empty() {
        let long = if thorough { THOROUGH } else { &[] };
        return Ok(STEPS.iter().chain(long).collect());
    }
    let all: Vec<&Step> = STEPS.iter().chain(THOROUGH).collect();
    let named = |name: &String| {
        let step = all.iter().find(|(step, _)| step == name).copied();
        step.ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|(step, _)| *step).collect();
            anyhow!("there is no step `{name}`; steps are: {}", known.join(", "))
        })
    };
    names.iter().map(named).collect()
}

fn print_table(table: &[(&str, Duration, String)], total: Duration) {
    eprintln!();
    for (name, time, verdict) in table {
        eprintln!("{name:<11} {:>7.1} s  {verdict}", time.as_secs_f64());
    }
    eprintln!("{:<11} {:>7.1} s", "total", total.as_secs_f64());
}

/// Runs the tests with one seed for all property tests, so that only a change decides whether they
/// pass. Tests run by hand draw a new seed.
fn tests() -> Result<Outcome> {
    let mut test = cargo(if installed("cargo-nextest") {
        "nextest run --workspace --all-features --status-level fail"
    } else {
        "test --workspace --all-features --lib --bins --tests --quiet"
    });
    passed(succeed(test.env("PROPTEST_RNG_SEED", "1")))
}

/// Runs every command that README, pages and help texts show.
fn commands() -> Result<Outcome> {
    // For the whole workspace, so that it reuses what the tests have compiled.
    let mut test = cargo("test --workspace --all-features --test commands --quiet -- --ignored");
    passed(succeed(test.env("TOLMAN", built("tolman")?.get_program())))
}

/// Compares the dependencies with the list of known weaknesses, where it can be fetched.
fn advisories() -> Result<Outcome> {
    if let Err(error) = succeed(&mut cargo("deny fetch db")) {
        return Ok(Outcome::Skipped(format!("no list of weaknesses: {error}")));
    }
    passes("deny --all-features check advisories")
}

/// Tests the pages that golden runs and shown commands have left, in a browser.
fn all_pages() -> Result<Outcome> {
    let target = workspace::target_folder()?;
    let folders = [target.join("golden"), target.join("tmp").join("commands")];
    if let Some(missing) = folders.iter().find(|folder| !folder.is_dir()) {
        bail!(
            "there is no {}: add `--step commands --step 'golden, all'`",
            missing.display()
        );
    }
    let mut test = cargo("test --workspace --all-features --test browser --quiet -- --ignored");
    passed(succeed(test.env("TOLMAN_PAGES", env::join_paths(folders)?)))
}

/// Checks that the fuzz targets build. Only running them needs a nightly compiler.
fn fuzz_targets() -> Result<Outcome> {
    let mut check = cargo("check --quiet --manifest-path fuzz/Cargo.toml");
    // Nothing is linked, so neither the C++ library nor a C++ compiler is needed.
    passed(succeed(
        check.env("CUSTOM_LIBFUZZER_PATH", "/nowhere/libfuzzer.a"),
    ))
}

fn typos() -> Command {
    let mut command = Command::new("typos");
    command.current_dir(workspace::root());
    command
}

fn if_installed(program: &str, step: fn() -> Result<Outcome>) -> Result<Outcome> {
    if installed(program) {
        step()
    } else {
        Ok(Outcome::Skipped(format!("{program} is not installed")))
    }
}

/// Runs a step that is one cargo command.
fn passes(arguments: &str) -> Result<Outcome> {
    passed(succeed(&mut cargo(arguments)))
}

fn passed(done: Result<()>) -> Result<Outcome> {
    done.map(|()| Outcome::Passed)
}
