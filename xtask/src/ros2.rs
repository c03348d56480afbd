//! `cargo xtask ros2`: the node of ROS 2, which is no member of the workspace, drives the robot of
//! MuJoCo over DDS. The robot speaks by Eclipse Cyclone DDS, an implementation of others. Both run
//! in a network of their own, with loopback only.

use std::process::Command;

use anyhow::{Result, ensure};
use serde_json::Value;

use crate::ci::Outcome;
use crate::mujoco::{self, Choice, Noise};
use crate::python::Environment;
use crate::workspace::{cargo, root, succeed, target_folder};

/// Manifest of the node.
const MANIFEST: &str = "crates/ros2/Cargo.toml";

/// The loop that plays mazes.
const LOOP: &str = "xtask/ros2/closed_loop.py";

/// Checks that the node says which topics do not fit.
const MISFITS: &str = "xtask/ros2/misfits.py";

/// Least share of right maps, of ways home and of goals reached, in a step of `ci`.
const ENOUGH: f64 = 0.9;

/// What is counted of a run.
const COUNTED: [&str; 3] = ["right", "home", "navigated"];

/// Plays the chosen mazes and tells how many maps are right.
///
/// # Errors
/// If a program fails.
pub(crate) fn run(choice: &Choice) -> Result<Outcome> {
    match play(choice)? {
        Ok(runs) => {
            let counted = COUNTED.map(|what| format!("{what} {}", count(&runs, what)));
            eprintln!(
                "{} over ROS 2, of {}: {}, done and wrong {}",
                choice.system,
                runs.len(),
                counted.join(", "),
                falsely_done(&runs),
            );
            Ok(Outcome::Passed)
        }
        Err(missing) => Ok(missing),
    }
}

/// Checks the node's form, lints it, tests it, and lets it learn twelve new mazes.
///
/// # Errors
/// If a test fails, or too few maps are right.
pub(crate) fn check() -> Result<Outcome> {
    if succeed(&mut here("fetch --locked --quiet")).is_err() {
        let why = "the crates of the ROS 2 node cannot be fetched";
        return Ok(Outcome::Missing(why.to_owned()));
    }
    succeed(here("fmt").args(["--", "--check"]))?;
    let mut lints = here("clippy --locked --quiet --all-targets --target-dir");
    lints.arg(target_folder()?);
    succeed(lints.args(["--", "--deny", "warnings"]))?;
    succeed(here("test --locked --quiet --target-dir").arg(target_folder()?))?;
    let choice = Choice {
        system: "mslst-better".to_owned(),
        noise: Noise::Real,
        maze: Vec::new(),
        seed: 1,
        each: 2,
        json: false,
    };
    let runs = match play(&choice)? {
        Ok(runs) => runs,
        Err(missing) => return Ok(missing),
    };
    if let Some((environment, _)) = mujoco::made()? {
        succeed(&mut beside_the_node(&environment, MISFITS)?)?;
    }
    for what in COUNTED {
        let (good, all) = (count(&runs, what), runs.len());
        ensure!(good as f64 >= ENOUGH * all as f64, "{good} of {all} {what}");
    }
    let wrong = falsely_done(&runs);
    ensure!(wrong == 0, "{wrong} wrong maps are called done");
    Ok(Outcome::Passed)
}

/// Returns a line of JSON for each maze, or what is missing.
fn play(choice: &Choice) -> Result<Result<Vec<Value>, Outcome>> {
    let missing = |why: &str| Ok(Err(Outcome::Missing(why.to_owned())));
    if succeed(&mut alone("true")).is_err() {
        return missing("a network of its own cannot be had here: `unshare -rn` fails");
    }
    let Some((environment, tolman)) = mujoco::made()? else {
        return missing("there is no Python with pip to install MuJoCo with");
    };
    succeed(here("build --locked --quiet --target-dir").arg(target_folder()?))?;
    let mut command = beside_the_node(&environment, LOOP)?;
    Ok(Ok(mujoco::lines(&mut command, choice, &tolman)?))
}

/// Returns a program in Python that is told where the node is.
fn beside_the_node(environment: &Environment, program: &str) -> Result<Command> {
    let mut command = alone("exec \"$@\"");
    command.arg(environment.python().get_program());
    command.arg(root().join(program));
    command.arg(target_folder()?.join("debug/tolman-ros2"));
    Ok(command)
}

/// Returns a shell that runs `script` in a network of its own; arguments follow.
fn alone(script: &str) -> Command {
    let mut command = Command::new("unshare");
    let script = format!("ip link set lo up && {script}");
    command.args(["--map-root-user", "--net", "sh", "-c", &script, "sh"]);
    command
}

fn count(runs: &[Value], what: &str) -> usize {
    runs.iter().filter(|run| run[what] == true).count()
}

fn falsely_done(runs: &[Value]) -> usize {
    let is_false = |run: &&Value| run["done"] == true && run["right"] != true;
    runs.iter().filter(is_false).count()
}

/// Returns a subcommand of cargo, with its arguments, for the node.
fn here(arguments: &str) -> Command {
    let (subcommand, rest) = arguments.split_once(' ').unwrap_or((arguments, ""));
    let mut command = cargo(&format!("{subcommand} --manifest-path {MANIFEST}"));
    command.args(rest.split_whitespace());
    command
}
