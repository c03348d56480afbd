//! `cargo xtask ci`: runs the steps that a change must pass, times each, and prints a table at the
//! end.

pub(crate) mod bare_metal;
mod firmware;
mod licences;
mod oldest;
mod outside;

use core::time::Duration;
use std::env;
use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Child, Command};
use std::time::Instant;

use anyhow::{Result, bail, ensure};
use clap::ValueEnum;

use Job::{Golden, Static, Tests, Thorough};

use crate::workspace::{self, built, cargo, installed, succeed};
use crate::{
    board, docs, fuzz, golden, layers, mazes, mouse_c, mujoco, mutants, packages, playground,
    prose, python, rerun, ros2, site,
};

/// Outcome of a step that did not fail.
pub(crate) enum Outcome {
    Passed,
    /// The step did not run: a tool is missing. Says which one, and how to install it.
    Missing(String),
}

/// The steps that one machine runs, beside the machines of the other jobs.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Job {
    /// Everything that runs none of the project's code, and the documentation
    Static,
    /// Tests, and packages by themselves
    Tests,
    /// Golden runs, shown commands, pages in a browser, and the chip
    Golden,
    /// What takes too long for every change
    Thorough,
}

/// A step, and the only job that it belongs to.
type Step = (&'static str, Job, fn() -> Result<Outcome>);

/// All steps, cheap and telling ones first. Lints, tests and docs have all features on, so that no
/// feature is missed and everything is compiled once. The program outside, bare metal and firmware
/// check builds without features.
const STEPS: &[Step] = &[
    ("format", Static, || passes("fmt --all --check")),
    ("layers", Static, || passed(layers::run())),
    ("prose", Static, || passed(prose::run())),
    ("links", Static, || passed(docs::pages())),
    ("spelling", Static, || {
        with("typos", "pip install typos", || {
            passed(succeed(&mut typos()))
        })
    }),
    ("licences", Static, || passed(licences::check())),
    ("advisories", Static, || {
        with("cargo-deny", "cargo install cargo-deny", advisories)
    }),
    ("lints", Static, oldest::lints),
    ("msrv", Static, oldest::suffices),
    ("api docs", Static, || passed(docs::api(oldest::cargo))),
    ("tests", Tests, tests),
    ("doc tests", Tests, || {
        passes("test --workspace --all-features --doc --quiet")
    }),
    ("package", Tests, || passed(packages::one())),
    ("outside", Tests, || passed(outside::check())),
    ("mazes", Golden, || passed(mazes::check_with(command))),
    ("golden", Golden, || {
        command()?;
        passed(golden::run_quick())
    }),
    ("commands", Golden, commands),
    ("browser", Golden, || with_browser(|| passes(BROWSER))),
    ("firmware", Golden, || {
        with("nm", "apt-get install binutils", firmware::check)
    }),
    ("bare metal", Golden, bare_metal::check),
    ("board", Golden, board::check),
    ("c", Golden, mouse_c::check),
    // The lints of the compiler that the tests use.
    ("new lints", Thorough, || {
        passes("clippy --workspace --all-features --all-targets --quiet -- --deny warnings")
    }),
    // The build of a user, without the features that only the steps above switch on.
    ("plain build", Thorough, || {
        passes("check --workspace --quiet")
    }),
    // The members of a workspace switch each other's default features on.
    ("no parry2d", Thorough, || {
        passes(
            "clippy --package tolman-sim --no-default-features --all-targets --quiet -- --deny warnings",
        )
    }),
    ("fuzz", Thorough, fuzz_targets),
    ("fuzzing", Thorough, || passed(fuzz::run(FUZZING, 1, &[]))),
    // Programs that are killed, or misbehave, again and again.
    ("endurance", Thorough, || {
        passes(
            "test --workspace --all-features --test cli --quiet -- --ignored a_thousand a_hundred",
        )
    }),
    ("mutants", Thorough, || mutants::check(MUTANTS, &[])),
    ("golden, all", Thorough, || passed(golden::run(&[], false))),
    ("pages", Thorough, || with_browser(all_pages)),
    ("python", Thorough, python::check),
    ("mujoco", Thorough, mujoco::check),
    ("rerun", Thorough, rerun::check),
    ("ros2", Thorough, ros2::check),
    ("playground", Thorough, playground::check),
    ("site", Thorough, site::check),
    ("packages", Thorough, || passed(packages::all())),
    // Every set of a crate's features by itself: the other steps turn on all of them or none.
    ("features", Thorough, || {
        with("cargo-hack", "cargo install cargo-hack", || {
            passes(
                "hack clippy --workspace --feature-powerset --exclude-features default --quiet -- --deny warnings",
            )
        })
    }),
];

/// The tests that open pages in a browser.
const BROWSER: &str = "test --workspace --all-features --test browser --quiet -- --ignored";

/// Some thirty changes of the code, spread over all crates that are changed.
const MUTANTS: mutants::Shard = mutants::Shard { first: 0, of: 400 };

/// Duration of fuzzing all readers, seconds.
const FUZZING: u64 = 600;

/// What to run.
#[derive(clap::Args)]
pub(crate) struct Choice {
    /// Run the remaining steps after one has failed
    #[arg(long)]
    keep_going: bool,
    /// Also run the long steps: fuzzing, programs that misbehave or are killed, mutants, the
    /// slowest golden runs, the Python module, replays for Rerun
    #[arg(long)]
    thorough: bool,
    /// Run the steps of this job alone
    #[arg(long, conflicts_with_all = ["thorough", "steps"])]
    job: Option<Job>,
    /// Run this step alone, long or short; may be given several times
    #[arg(long = "step", value_name = "NAME", value_parser = known)]
    steps: Vec<String>,
    /// Pass without this step if its tool is missing; may be given several times. Where CI is set,
    /// any other step that cannot run is a failure
    #[arg(long, value_name = "NAME", value_parser = known)]
    may_miss: Vec<String>,
}

impl Choice {
    /// Returns whether all steps are to run that a change must pass.
    fn is_whole(&self) -> bool {
        self.job.is_none() && self.steps.is_empty()
    }

    /// Returns whether a step is to run.
    fn has(&self, step: &Step) -> bool {
        match self.job {
            Some(job) => step.1 == job,
            None if self.steps.is_empty() => self.thorough || step.1 != Thorough,
            None => self.steps.iter().any(|name| name == step.0),
        }
    }
}

/// The steps that a whole run starts beside those that follow: they have a compiler and a folder of
/// their own, and neither they nor the others always keep two cores busy.
const BESIDE: [&str; 3] = ["lints", "msrv", "api docs"];

/// The run of the steps beside the others.
struct Beside {
    child: Child,
    /// What it writes, shown when it is over.
    log: PathBuf,
}

impl Beside {
    fn start(choice: &Choice) -> Result<Self> {
        let log = workspace::target_folder()?.join("beside.txt");
        let file = File::create(&log)?;
        let mut command = Command::new(env::current_exe()?);
        command.arg("ci").stdout(file.try_clone()?).stderr(file);
        for step in BESIDE {
            command.args(["--step", step]);
        }
        for step in choice
            .may_miss
            .iter()
            .filter(|step| BESIDE.contains(&step.as_str()))
        {
            command.args(["--may-miss", step]);
        }
        let child = command.spawn()?;
        Ok(Self { child, log })
    }

    /// Waits for its end, shows what it wrote, and returns whether it passed.
    fn end(mut self) -> Result<Outcome> {
        let status = self.child.wait()?;
        eprint!("\n{}", fs::read_to_string(&self.log)?);
        ensure!(status.success(), "of {}: {status}", BESIDE.join(", "));
        Ok(Outcome::Passed)
    }
}

/// Returns a step's name, if there is such a step.
fn known(name: &str) -> Result<String> {
    let names: Vec<&str> = STEPS.iter().map(|step| step.0).collect();
    ensure!(names.contains(&name), "steps are: {}", names.join(", "));
    Ok(name.to_owned())
}

/// Runs the chosen steps in order. The first failure ends the run unless it is to keep going. Where
/// CI is set, a step whose tool is missing fails, unless it may be missed.
///
/// # Errors
/// If a step failed, or did not run but must.
pub(crate) fn run(choice: &Choice) -> Result<()> {
    let in_ci = env::var_os("CI").is_some();
    let start = Instant::now();
    let steps = STEPS.iter().filter(|step| choice.has(step));
    let mut table = Vec::new();
    let mut failures = 0;
    let mut beside = None;
    for (name, _, step) in steps {
        let goes_on = failures == 0 || choice.keep_going;
        if choice.is_whole() && BESIDE.contains(name) && (goes_on || beside.is_some()) {
            if beside.is_none() {
                beside = Some(Beside::start(choice)?);
            }
            continue;
        }
        eprintln!("\n== {name}");
        let begun = Instant::now();
        let result = if goes_on {
            step()
        } else {
            let why = "a step before it failed (--keep-going runs it)".to_owned();
            Ok(Outcome::Missing(why))
        };
        if let Err(error) = &result {
            eprintln!("error: {error:#}");
        }
        failures += u32::from(fails(
            &result,
            !in_ci || choice.may_miss.iter().any(|may| may == name),
        ));
        table.push((*name, begun.elapsed(), result));
    }
    if let Some(beside) = beside {
        let result = beside.end();
        failures += u32::from(result.is_err());
        table.push(("those beside", start.elapsed(), result));
    }
    print_table(&table, start.elapsed());
    ensure!(
        failures == 0,
        "{failures} of {} steps failed or did not run",
        table.len()
    );
    Ok(())
}

/// Returns whether the result of a step, which may be missed or not, lets the whole run fail.
fn fails(result: &Result<Outcome>, may_miss: bool) -> bool {
    match result {
        Ok(Outcome::Passed) => false,
        Ok(Outcome::Missing(_)) => !may_miss,
        Err(_) => true,
    }
}

/// Prints how long each step took, and at the end which did not run.
fn print_table(table: &[(&str, Duration, Result<Outcome>)], total: Duration) {
    eprintln!();
    for (name, time, result) in table {
        let told = match result {
            Ok(Outcome::Passed) => "ok",
            Ok(Outcome::Missing(_)) => "NOT RUN",
            Err(_) => "FAILED",
        };
        eprintln!("{name:<12} {:>7.1} s  {told}", time.as_secs_f64());
    }
    eprintln!("{:<12} {:>7.1} s", "total", total.as_secs_f64());
    for (name, _, result) in table {
        if let Ok(Outcome::Missing(why)) = result {
            eprintln!("NOT RUN: {name}: {why}");
        }
    }
}

/// Returns the command as the tests build it, all features on, and builds it if they have not.
pub(crate) fn command() -> Result<Command> {
    // For the whole workspace, so that it reuses what the tests have compiled.
    succeed(&mut cargo(
        "test --workspace --all-features --test commands --no-run --quiet",
    ))?;
    built("tolman")
}

/// Runs the tests with one seed for all property tests, so that only a change decides whether they
/// pass. Tests run by hand draw a new seed.
fn tests() -> Result<Outcome> {
    let mut test = cargo(if installed("cargo-nextest") {
        "nextest run --workspace --all-features --lib --bins --tests --status-level fail"
    } else {
        "test --workspace --all-features --lib --bins --tests --quiet"
    });
    passed(succeed(test.env("PROPTEST_RNG_SEED", "1")))
}

/// Runs every command that README, pages and help texts show.
fn commands() -> Result<Outcome> {
    let mut test = cargo("test --workspace --all-features --test commands --quiet -- --ignored");
    passed(succeed(test.env("TOLMAN", command()?.get_program())))
}

/// Compares the dependencies with the list of known weaknesses, where it can be fetched.
fn advisories() -> Result<Outcome> {
    if let Err(error) = succeed(&mut cargo("deny fetch db")) {
        return Ok(Outcome::Missing(format!("no list of weaknesses: {error}")));
    }
    passes("deny --all-features check advisories bans")
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
    passed(succeed(
        cargo(BROWSER).env("TOLMAN_PAGES", env::join_paths(folders)?),
    ))
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

/// Runs a step that needs a program, and says how to install it if it is missing.
pub(crate) fn with(
    program: &str,
    how: &str,
    step: impl Fn() -> Result<Outcome>,
) -> Result<Outcome> {
    if installed(program) {
        step()
    } else {
        Ok(Outcome::Missing(format!(
            "{program} is not installed: {how}"
        )))
    }
}

fn with_browser(step: fn() -> Result<Outcome>) -> Result<Outcome> {
    with(
        "chromium",
        "apt-get install chromium fonts-dejavu-core",
        step,
    )
}

/// Runs a step that is one cargo command.
fn passes(arguments: &str) -> Result<Outcome> {
    passed(succeed(&mut cargo(arguments)))
}

fn passed(done: Result<()>) -> Result<Outcome> {
    done.map(|()| Outcome::Passed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a choice as the command line makes it.
    fn choice(arguments: &str) -> Choice {
        #[derive(clap::Parser)]
        struct Line {
            #[command(flatten)]
            choice: Choice,
        }
        let words = ["ci"].into_iter().chain(arguments.split_whitespace());
        <Line as clap::Parser>::parse_from(words).choice
    }

    fn names(arguments: &str) -> Vec<&'static str> {
        let choice = choice(arguments);
        let chosen = STEPS.iter().filter(|step| choice.has(step));
        chosen.map(|step| step.0).collect()
    }

    /// Returns the names of the jobs that a change must pass.
    fn jobs() -> Vec<String> {
        let jobs = Job::value_variants().iter();
        let jobs = jobs.filter(|job| **job != Thorough);
        let names = jobs.filter_map(|job| Some(job.to_possible_value()?.get_name().to_owned()));
        names.collect()
    }

    #[test]
    fn the_jobs_together_are_the_whole_run() {
        let of_job = |job: &String| {
            let steps = names(&format!("--job {job}"));
            assert!(!steps.is_empty(), "{job}");
            steps
        };
        assert_eq!(
            jobs().iter().flat_map(of_job).collect::<Vec<_>>(),
            names("")
        );
        assert_eq!(names("--thorough").len(), STEPS.len());
        assert_eq!(names("--step tests"), ["tests"]);
        assert!(known("test").is_err());
    }

    #[test]
    fn the_workflow_runs_every_job() {
        let text = workspace::read(&workspace::root().join(".github/workflows/ci.yml")).unwrap();
        assert!(text.contains(&format!("job: [{}]", jobs().join(", "))));
    }

    #[test]
    fn a_step_that_must_run_and_did_not_fails() {
        let missing = Ok(Outcome::Missing("no compiler: buy one".to_owned()));
        assert!(fails(&missing, false));
        assert!(!fails(&missing, true));
        assert!(fails(&Err(anyhow::anyhow!("broken")), true));
        assert!(!fails(&Ok(Outcome::Passed), false));
    }
}
