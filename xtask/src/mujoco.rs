//! `cargo xtask mujoco`: systems drive a robot in MuJoCo, a simulator of others, as they drive any
//! robot: as a process of its own. MuJoCo is installed into an environment of its own,
//! `target/mujoco`.

use std::fs;
use std::io::Write as _;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::ValueEnum;
use serde_json::Value;

use crate::ci::Outcome;
use crate::python::{Environment, system_python};
use crate::workspace::{cargo, output, root, succeed, target_folder};

/// Packages that the robot and its world are made of, and what it speaks over ROS 2.
const PACKAGES: &[&str] = &["mujoco==4.0.0", "numpy>=2,<3", "cyclonedds==11.0.1"];

/// Folder of the robot and of the loop that plays mazes.
const FOLDER: &str = "xtask/mujoco";

/// Families of the mazes that are played if none is named, with their sizes.
const FAMILIES: [(&str, &str); 6] = [
    ("perfect", "5x5"),
    ("braided", "5x5"),
    ("office", "5x5"),
    ("comb", "5x3"),
    ("spiral", "5x5"),
    ("blocks", "5x5"),
];

/// Least share of right maps, and of ways home, in a step of `ci`.
const ENOUGH: f64 = 0.95;

/// What to play.
#[derive(clap::Args)]
pub(crate) struct Choice {
    /// System that drives
    #[arg(long, default_value = "mslst-better")]
    pub(crate) system: String,
    /// Errors of sensors, wheels and floor
    #[arg(long, default_value = "real")]
    pub(crate) noise: Noise,
    /// Maze to play; may be given several times. Without it, new mazes of six families
    #[arg(long, value_name = "FILE")]
    pub(crate) maze: Vec<PathBuf>,
    /// Seed of the mazes, the noise and the system
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Number of mazes of each family
    #[arg(long, default_value_t = 1)]
    pub(crate) each: u64,
    /// Write a line of JSON for each maze
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Noise {
    /// Exact sensors. Wheels slip in any case
    None,
    /// Ranges ± 10 mm, 0.5 % lost beams, a compass ± 1.5° that iron bends by 3°, odometry off by
    /// 1 % and its turns by 3 %
    Real,
    /// As real, with scans 0.7 s old: a driver that does not wait until the robot rests
    Late,
    /// Ranges ± 15 mm ± 1 %, 3 % lost beams, a compass off by 3° that iron bends by 5°, odometry
    /// off by 2 %, one wheel 1 % larger, a slippery floor, scans 0.1 s old
    Hard,
}

/// Plays the chosen mazes and tells how many maps are right.
///
/// # Errors
/// If Python or MuJoCo cannot be had, or a program fails.
pub(crate) fn run(choice: &Choice) -> Result<Outcome> {
    let Some((environment, tolman)) = made()? else {
        let why = "there is no Python with pip to install MuJoCo with (PYTHON names another)";
        return Ok(Outcome::Missing(why.to_owned()));
    };
    let runs = play(choice, &environment, &tolman)?;
    let share = |name: &str| {
        let good = runs.iter().filter(|run| run[name] == true).count();
        format!("{good} of {}", runs.len())
    };
    let lies = runs.iter().filter(|run| is_false_claim(run)).count();
    eprintln!(
        "{}, noise {}: right {}, home {}, claimed right and wrong {lies}",
        choice.system,
        name(choice.noise),
        share("right"),
        share("home"),
    );
    Ok(Outcome::Passed)
}

/// Plays new mazes with the better systems, and checks that enough maps are right.
///
/// # Errors
/// If too few are, or a program fails.
pub(crate) fn check() -> Result<Outcome> {
    for system in ["mslst-better", "diktiometry-better"] {
        let Some((environment, tolman)) = made()? else {
            let why = "there is no Python with pip to install MuJoCo with";
            return Ok(Outcome::Missing(why.to_owned()));
        };
        let choice = Choice {
            system: system.to_owned(),
            noise: Noise::Real,
            maze: Vec::new(),
            seed: 1,
            each: 4,
            json: false,
        };
        let runs = play(&choice, &environment, &tolman)?;
        for what in ["right", "home"] {
            let good = runs.iter().filter(|run| run[what] == true).count();
            let share = good as f64 / runs.len() as f64;
            ensure!(share >= ENOUGH, "{system}: {good} of {} {what}", runs.len());
        }
        let lies = runs.iter().filter(|run| is_false_claim(run)).count();
        ensure!(lies == 0, "{system} claims {lies} wrong maps");
    }
    Ok(Outcome::Passed)
}

fn is_false_claim(run: &Value) -> bool {
    run["claimed"] == true && run["right"] != true
}

fn name(noise: Noise) -> String {
    let value = noise.to_possible_value();
    value.map_or_else(String::new, |value| value.get_name().to_owned())
}

/// Returns the environment and the command; `None` without Python.
pub(crate) fn made() -> Result<Option<(Environment, PathBuf)>> {
    let Some(system) = system_python() else {
        return Ok(None);
    };
    let target = target_folder()?;
    let environment = Environment {
        folder: target.join("mujoco"),
    };
    let has_it = |environment: &Environment| {
        let probe = environment
            .python()
            .args(["-c", "import mujoco, cyclonedds"])
            .output();
        probe.is_ok_and(|output| output.status.success())
    };
    if !has_it(&environment) {
        environment.clear(&system)?;
        if environment.install(PACKAGES).is_err() {
            return Ok(None);
        }
    }
    // As the tests build it: the brain waits for MuJoCo's physics, not the other way round.
    succeed(&mut cargo("build --quiet -p tolman"))?;
    Ok(Some((environment, target.join("debug/tolman"))))
}

/// Plays the mazes one by one and returns the lines of JSON.
fn play(choice: &Choice, environment: &Environment, tolman: &Path) -> Result<Vec<Value>> {
    let mut command = environment.python();
    command.arg(root().join(FOLDER).join("play.py"));
    lines(&mut command, choice, tolman)
}

/// Lets a loop play the chosen mazes and returns its lines of JSON.
pub(crate) fn lines(command: &mut Command, choice: &Choice, tolman: &Path) -> Result<Vec<Value>> {
    let mazes = match choice.maze.as_slice() {
        [] => fresh(choice, tolman)?,
        mazes => mazes.to_vec(),
    };
    command.arg("--tolman").arg(tolman);
    command.args(["--system", &choice.system, "--noise", &name(choice.noise)]);
    command
        .args(["--seed", &choice.seed.to_string()])
        .args(mazes);
    let mut child = command.stdout(Stdio::piped()).spawn()?;
    let lines = child.stdout.take().context("the loop has no output")?;
    let mut runs = Vec::new();
    for line in BufReader::new(lines).lines() {
        let run: Value = serde_json::from_str(&line?).context("the loop writes lines of JSON")?;
        match choice.json {
            true => writeln!(io::stdout(), "{run}")?,
            false => eprintln!("{run}"),
        }
        runs.push(run);
    }
    let status = child.wait()?;
    ensure!(status.success(), "the loop failed: {status}");
    Ok(runs)
}

/// Makes new mazes and returns their files.
fn fresh(choice: &Choice, tolman: &Path) -> Result<Vec<PathBuf>> {
    let folder = target_folder()?.join("mujoco/mazes");
    fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let mut mazes = Vec::new();
    for number in 0..choice.each {
        for (family, size) in FAMILIES {
            let seed = choice.seed + number;
            let file = folder.join(format!("{family}-{seed}.maze"));
            let mut generate = Command::new(tolman);
            generate.args(["maze", "generate", family, "--size", size]);
            output(
                generate
                    .args(["--seed", &seed.to_string(), "--out"])
                    .arg(&file),
            )?;
            mazes.push(file);
        }
    }
    Ok(mazes)
}
