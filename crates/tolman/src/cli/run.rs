//! `tolman run`: one robot, one maze, one seed.

mod brain;
mod live;
mod picture;
mod start;
mod trace;

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use brain::Brain;
use live::Live;
use serde_json::json;
use start::Start;
use tolman::agents::Cast;
use tolman::course::Course;
use tolman::episode::{self, Episode, EpisodeError, Trial};
use tolman::pioneer::{body, calibrated};
use tolman::replay::{Fact, Recorder};

use super::failure::OrBadInput;
use super::replay_file::{self, Overwrite};
use super::{Failure, called, file, maze};

/// Sends one robot through a maze and tells what became of it
#[derive(clap::Args)]
#[command(after_help = "\
The same brain, maze, start and seed make the same run, on any machine. With the seed of a line of
runs.jsonl, the default start and the step_limit of its world in config.toml as --steps, it is the run of
that line.

Examples:
  tolman run wall-follow --maze mazes/j.maze --seed 7 --svg run.svg
  tolman run wall-follow --maze mazes/large.maze --live
  tolman run wall-follow --maze mazes/large.maze --replay run.html
  tolman run avoid --maze taiwan2016f.txt --start marked --steps 20000")]
pub(super) struct Arguments {
    /// Who chooses the actions
    brain: Brain,
    /// The maze file, of any format; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// What all chance of the run follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Where the robot starts: random, marked (where the maze says), or X,Y or X,Y,DEG in metres
    /// and degrees from the south-west corner, counter-clockwise from east
    #[arg(
        long,
        value_name = "WHERE",
        default_value = "random",
        allow_hyphen_values = true
    )]
    start: Start,
    /// Give up after so many time steps; if not given, in proportion to the length of the corridors, as
    /// many for each metre as the Large maze's 500
    #[arg(long, value_name = "LIMIT", value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
    /// Show it on the terminal as it goes; space pauses, → steps, + and - change the speed, q stops looking
    #[arg(long)]
    live: bool,
    /// Draw its way over the maze
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the run down step by step, as JSON lines: world, robot, and every command, true pose, bump and
    /// scan
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Write a replay: one HTML file that plays the run in any browser
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
    /// Overwrite the replay's file even if it is no replay
    #[arg(long, requires = "replay")]
    force: bool,
    /// Write the outcome as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let overwrite = Overwrite::if_forced(arguments.force);
    if let Some(path) = &arguments.replay {
        replay_file::check(path, overwrite)?;
    }
    let read = maze::read(&arguments.maze)?;
    let robot = calibrated();
    let course = Course::new(&maze::name(&arguments.maze), &read, &body())
        .with_context(|| maze::name(&arguments.maze))
        .or_bad_input()?;
    let start = arguments.start.on(&course, arguments.seed)?;
    let trial = Trial {
        course: &course,
        robot: robot.clone(),
        start,
        step_limit: arguments.steps.unwrap_or_else(|| course.step_limit()),
        seed: arguments.seed,
    };
    let mut mind = Cast::default()
        .mind(arguments.brain.0, &course, &robot)
        .map_err(classify)?;
    let mut live = match arguments.live {
        true => Some(Live::open(&trial, &arguments.brain.to_string())?),
        false => None,
    };
    let mut commands = Vec::new();
    let mut recorder = Recorder::new(&trial);
    let episode = episode::run(&trial, &mut mind, |step| {
        commands.push(step.command);
        recorder.see(step);
        if let Some(live) = &mut live {
            live.watch(step);
        }
    })
    .map_err(classify)?;
    let told = arguments.told(&episode);
    if let Some(live) = live {
        live.close(&told).context("the terminal has gone")?;
    }
    if let Some(path) = &arguments.trace {
        file::write_bytes(path, &trace::of(&trial, &commands)?)?;
    }
    if let Some(path) = &arguments.svg {
        file::write(path, &picture::of(&course, &episode, &told))?;
    }
    if let Some(path) = &arguments.replay {
        let title = format!("{} in {}", arguments.brain.0.name(), course.name);
        let mut replay = recorder.finish(title, &episode);
        let brain = Fact::new("brain", arguments.brain.0.name());
        replay.facts.insert(1, brain);
        let replay = replay.fact("made by", called::command());
        replay_file::write(path, &replay, overwrite)?;
    }
    if arguments.json {
        let json = json!({
            "brain": arguments.brain.to_string(),
            "maze": course.name,
            "seed": arguments.seed,
            "start": {
                "x": start.position.x,
                "y": start.position.y,
                "heading_deg": start.heading.degrees(),
            },
            "reached": episode.reached,
            "actions": episode.actions,
            "failed_actions": episode.failed_actions,
            "steps": episode.steps,
            "step_limit": trial.step_limit,
            "bumps": episode.bumps,
        });
        writeln!(out, "{json:#}")?;
        return Ok(());
    }
    writeln!(out, "{told}")?;
    if let Some(path) = &arguments.replay {
        writeln!(out, "replay: {}", replay_file::address(path))?;
    }
    Ok(())
}

impl Arguments {
    /// The outcome in words.
    fn told(&self, episode: &Episode) -> String {
        let Episode {
            actions,
            failed_actions,
            steps,
            bumps,
            ..
        } = episode;
        let came = if episode.reached {
            "reached the destination"
        } else {
            "did not arrive"
        };
        format!(
            "{} {came}: {steps} steps, {actions} actions of which {failed_actions} failed, \
             {bumps} bumps",
            self.brain
        )
    }
}

/// A start or a maze that does not serve is the caller's to mend.
fn classify(error: EpisodeError) -> Failure {
    match error {
        EpisodeError::Start(_) | EpisodeError::Layers(_) | EpisodeError::Policy { .. } => {
            Failure::BadInput(error.into())
        }
        _ => Failure::Failed(error.into()),
    }
}
