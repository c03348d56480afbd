//! `tolman run`: one robot, one maze or world, one seed.

mod outing;
mod trace;

use std::io::Write;

use anyhow::Context;
use tolman_arena::cast::Cast;

use super::{App, Failure};
pub(super) use outing::{Name, Outing, carry_out as send};

/// Sends one robot through a maze or a world and reports the result
#[derive(clap::Args)]
#[command(after_help = "\
The same brain, maze, start and seed make the same run, on any machine. To repeat the run of a line in runs.jsonl,
give its --seed, and as --steps the step_limit of its world in config.toml.

Examples:
  tolman run wall-follow --maze mazes/j.maze --seed 7 --svg run.svg
  tolman run wall-follow --maze mazes/large.maze --live
  tolman run wall-follow --maze mazes/large.maze --replay run.html
  tolman run avoid --maze mazes/grid/braided-2.txt --start marked --steps 20000
  tolman run wall-follow --world mazes/worlds/rooms.json --seed 3
  tolman run wall-follow --world mazes/worlds/hall.yaml --goal 2,0 --seed 2")]
pub(super) struct Arguments {
    /// Brain that chooses the actions: a baseline of `tolman systems`
    #[arg(value_name = "BRAIN")]
    brain: String,
    #[command(flatten)]
    outing: Outing,
}

pub(super) fn carry_out(
    app: &App<'_>,
    arguments: &Arguments,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let brain = app.system(&arguments.brain, |system| system.baseline().is_some())?;
    let name = Name {
        word: brain.name(),
        title: brain.title(),
        nodes: &[],
    };
    let mind = |course: &_, robot: &_| {
        let agent = brain.baseline().context("a baseline")?;
        let mind = Cast::default().mind(agent, course, robot);
        mind.map_err(outing::classify)
    };
    send(&arguments.outing, name, mind, out)
}
