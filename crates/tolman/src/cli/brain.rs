//! `tolman brain`: a system drives a robot that is another process.

use std::io::{self, BufReader};
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use tolman_arena::foreign::{NamedTask, Service, ServiceError, WireError};
use tolman_robot::{RobotMeasures, Standing};

use super::words::words;
use super::{App, Failure, OrBadInput, Result, file};

/// Lets a system drive your robot, in whatever language its driver is; exits 1 if it gives up
///
/// Your program starts this one and talks with it in lines of JSON. It reads a motion from this
/// program's standard output, makes it, and writes what the robot then senses to its standard
/// input. `docs/brain.md` has all messages.
#[derive(clap::Args)]
#[command(after_help = "\
What the brain writes, and what your program answers:
  {\"hello\": {\"protocol\": 1, \"system\": \"mslst-better\"}}
  {\"go\": {\"turn\": 0.1, \"distance\": 0.2}}  ->  {\"sensing\": {\"time_us\": 0, \"ranges\": […], \"compass\": …, \"odometry\": {\"distance\": …, \"turn\": …}}, \"landmark\": null}
  {\"ended\": {\"task\": \"explore\", \"standing\": \"done\", …}}

Turns are rad, counter-clockwise, and distances m. The measures are a file of TOML:
  diameter = 0.247          # of the circle in which the robot turns, m
  corridor_width = 0.47     # from wall to wall, m
  compass_error = 0.07      # largest, rad
  odometry_error = 0.05     # largest, as a share of the distance
  [laser]
  beams = 360               # all round, the first ahead
  least_range = 0.12        # m
  max_range = 3.5           # m
  x = -0.032                # ahead of the middle of the axle, m

A reading that is not a number, of another ring, from an earlier time or missing stops the robot, and the error names its
line: exit code 2.")]
pub(super) struct Arguments {
    /// System that drives; `tolman systems` lists them
    #[arg(long, value_name = "NAME")]
    system: String,
    /// Measures of the robot and its corridors, a file of TOML
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// Task to carry out; may be given several times. Without it the robot's program names them
    #[arg(long, value_name = "TASK", value_parser = words(TASKS))]
    task: Vec<NamedTask>,
    /// Seed of all random numbers: the same seed and the same readings give the same motions
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

/// Values of `--task`.
const TASKS: [(&str, &str, NamedTask); 3] = [
    ("explore", "Learn the world", NamedTask::Explore),
    ("reach-goal", "Go to the goal", NamedTask::ReachGoal),
    (
        "localize",
        "Find the robot's place on the map",
        NamedTask::Localize,
    ),
];

pub(super) fn carry_out(app: &App, arguments: &Arguments) -> Result {
    let system = app.system(&arguments.system, |_| true)?;
    let path = &arguments.robot;
    let text = file::read(path, "give the measures of your robot, a file of TOML")?;
    let measures: RobotMeasures = toml::from_str(&text)
        .with_context(|| format!("{}: these are no measures of a robot", path.display()))
        .or_bad_input()?;
    let checked = measures.check();
    let checked = checked.with_context(|| format!("{} contradicts itself", path.display()));
    checked.or_bad_input()?;
    let (from, to) = (BufReader::new(io::stdin()), io::stdout());
    let service = Service::new(
        system,
        measures,
        arguments.seed,
        Box::new(from),
        Box::new(to),
    );
    let ended = service.and_then(|mut service| service.run(&arguments.task));
    match ended {
        Ok(Standing::GaveUp { why }) => {
            Err(Failure::Failed(anyhow!("{} gave up: {why}", system.name())))
        }
        Ok(_) => Ok(()),
        Err(error) => Err(failure(error)),
    }
}

/// Returns whose fault it is that a brain ended early.
fn failure(error: ServiceError) -> Failure {
    match error {
        ServiceError::Wire(WireError::Io { .. } | WireError::Ended { .. })
        | ServiceError::System { .. } => Failure::Failed(error.into()),
        _ => Failure::BadInput(error.into()),
    }
}
