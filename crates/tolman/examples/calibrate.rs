//! How the baselines depend on the robot: the sweep behind the calibration in `docs/mslst.md`.
//!
//! `cargo run --release -p tolman --example calibrate -- [RUNS]` lets Avoid and Wall-follow make
//! RUNS runs (default 200) in the J and the Large maze. It does so with the frozen robot, then with
//! one of its figures changed at a time, and prints a table. Nothing reads what it prints.

use std::io::{self, Write};

use rayon::prelude::*;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{self, Trial};
use tolman_arena::pioneer;
use tolman_sim::robots::LaserPioneerConfig;
use tolman_systems::mslst::ROBOT_UNIT;

type BoxError = Box<dyn core::error::Error + Send + Sync>;

/// The mazes with the paper's limits, time steps.
const MAZES: [(&str, &str, u32); 2] = [
    ("J", include_str!("../mazes/j-long.maze"), 200),
    ("Large", include_str!("../mazes/large-hard.maze"), 500),
];

/// Sets one figure of the robot to a value.
type Change = fn(&mut LaserPioneerConfig, f64);

/// The sweeps: each has a name, its values, and the change that a value makes to the frozen robot.
const SWEEP: [(&str, &[f64], Change); 5] = [
    (
        "turn of a full command, degrees",
        &[60.0, 75.0, 85.0, 91.0, 95.0],
        |robot, degrees| {
            robot.turn_per_step = degrees.to_radians();
        },
    ),
    (
        "way of an action, robot units",
        &[0.8, 0.9, 1.0, 1.1, 1.2],
        |robot, units| {
            // Two steps at a quarter of the full command.
            robot.translate_per_step = 2.0 * units * ROBOT_UNIT;
        },
    ),
    (
        "relative noise of a turn, sd",
        &[0.0, 0.06, 0.12, 0.18, 0.3],
        |robot, sd| {
            robot.motor_noise.turn.relative_sd = sd;
        },
    ),
    (
        "relative noise of a translation, sd",
        &[0.0, 0.1, 0.25, 0.4],
        |robot, sd| {
            robot.motor_noise.translate.relative_sd = sd;
        },
    ),
    (
        "drift, degrees a metre",
        &[0.0, 2.0, 4.0, 8.0, 16.0],
        |robot, degrees| {
            robot.motor_noise.drift_sd = degrees.to_radians();
        },
    ),
];

fn main() -> Result<(), BoxError> {
    let runs: u64 = match std::env::args().nth(1) {
        Some(text) => text
            .parse()
            .map_err(|_| format!("{text:?} is not a number of runs"))?,
        None => 200,
    };
    let mut courses = Vec::new();
    for (name, text, limit) in MAZES {
        courses.push((
            Course::for_body(name, &tolman_maze::read(text)?, &pioneer::body())?,
            limit,
        ));
    }
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "| robot | maze | Avoid: success %, steps, steps / action | Wall-follow |"
    )?;
    writeln!(out, "| --- | --- | --- | --- |")?;
    line(&mut out, "frozen", &pioneer::calibrated(), &courses, runs)?;
    for (what, values, change) in SWEEP {
        for &value in values {
            let mut robot = pioneer::calibrated();
            change(&mut robot, value);
            line(
                &mut out,
                &format!("{what}: {value}"),
                &robot,
                &courses,
                runs,
            )?;
        }
    }
    Ok(())
}

fn line(
    out: &mut impl Write,
    name: &str,
    robot: &LaserPioneerConfig,
    courses: &[(Course, u32)],
    runs: u64,
) -> Result<(), BoxError> {
    for (course, limit) in courses {
        let avoid = row(robot, course, *limit, runs, Agent::Avoid)?;
        let wall_follow = row(robot, course, *limit, runs, Agent::WallFollow)?;
        writeln!(
            out,
            "| {name} | {} | {avoid} | {wall_follow} |",
            course.name
        )?;
    }
    Ok(())
}

fn row(
    robot: &LaserPioneerConfig,
    course: &Course,
    step_limit: u32,
    runs: u64,
    agent: Agent,
) -> Result<String, BoxError> {
    let episodes: Result<Vec<_>, _> = (0..runs)
        .into_par_iter()
        .map(|seed| {
            let start = episode::random_start(course, &pioneer::body(), seed);
            let trial = Trial {
                course,
                robot: robot.clone(),
                start,
                step_limit,
                seed,
            };
            let mut mind = Cast::default().mind(agent, course, robot)?;
            episode::run(&trial, &mut mind, |_| {})
        })
        .collect();
    let episodes = episodes?;
    let mean = |of: fn(&episode::Episode) -> u32| {
        episodes
            .iter()
            .map(|episode| f64::from(of(episode)))
            .sum::<f64>()
            / runs as f64
    };
    let (steps, actions) = (
        mean(|episode| episode.steps),
        mean(|episode| episode.actions),
    );
    let success = 100.0 * mean(|episode| u32::from(episode.reached));
    Ok(format!("{success:.0}, {steps:.0}, {:.2}", steps / actions))
}
