//! `tolman demo`: something to look at, without a file or an argument.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{self, Trial, random_start};
use tolman_arena::pioneer::{body, calibrated};
use tolman_papers::Recorder;
use tolman_replay::Fact;

use super::Failure;
use super::replay_file::{self, Overwrite};

/// Runs a robot through the Large maze and leaves a replay to open in a browser
#[derive(clap::Args)]
#[command(after_help = "\
The file is tolman-demo.html in the current folder, or tolman-demo-2.html … where that is taken.

Examples:
  tolman demo
  tolman demo --out /tmp/demo.html")]
pub(super) struct Arguments {
    /// The file to write
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite the file even if it is no replay
    #[arg(long, requires = "out")]
    force: bool,
}

/// The maze comes with the program, so that it runs in any folder.
const MAZE: &str = include_str!("../../../../mazes/large-hard.maze");

/// What the robot does.
const AGENT: Agent = Agent::WallFollow;

/// A start from which the robot sees much of the maze before it arrives.
const SEED: u64 = 7;

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let overwrite = Overwrite::if_forced(arguments.force);
    let path = match &arguments.out {
        Some(path) => path.clone(),
        None => free_name()?,
    };
    replay_file::check(&path, overwrite)?;
    let maze = tolman_maze::read(MAZE).context("the maze of this program")?;
    let robot = calibrated();
    let course = Course::for_body("Large", &maze, &body()).context("the maze of this program")?;
    let trial = Trial {
        course: &course,
        robot: robot.clone(),
        start: random_start(&course, &body(), SEED),
        step_limit: 10 * course.step_limit(),
        seed: SEED,
    };
    let mut mind = Cast::default().mind(AGENT, &course, &robot)?;
    let mut recorder = Recorder::new(&trial);
    let episode = episode::run(&trial, &mut mind, |step| recorder.see(step))?;
    let mut replay = recorder.finish("A wall follower in the Large maze", &episode);
    replay.facts.insert(1, Fact::new("brain", AGENT.name()));
    replay_file::write(&path, replay, overwrite)?;
    let steps = episode.steps;
    if !episode.reached {
        return Err(Failure::Failed(anyhow!(
            "the robot did not find the destination of the Large maze in {steps} steps"
        )));
    }
    writeln!(
        out,
        "A robot that keeps to the wall on its right found the destination of the Large maze in {steps} steps."
    )?;
    Ok(writeln!(out, "replay: {}", replay_file::address(&path))?)
}

/// A name that nothing has yet.
fn free_name() -> Result<PathBuf, Failure> {
    let names = (1..1000).map(|number| match number {
        1 => "tolman-demo.html".to_owned(),
        _ => format!("tolman-demo-{number}.html"),
    });
    let mut free = names.filter(|name| std::fs::symlink_metadata(Path::new(name)).is_err());
    free.next().map(PathBuf::from).ok_or_else(|| {
        Failure::BadInput(anyhow!(
            "a thousand demos are here already; name a file with --out"
        ))
    })
}
