//! `tolman run`: one robot, one maze or world, one seed.

mod outing;
mod trace;

use std::io::Write;

use tolman_arena::cast::{Agent, Cast};

use super::Failure;
use super::words::words;
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
    /// Brain that chooses the actions
    #[arg(value_parser = words(BRAINS.map(|(word, agent)| (word, agent.description(), (word, agent)))))]
    brain: (&'static str, Agent),
    #[command(flatten)]
    outing: Outing,
}

/// The agents with their names on the command line.
const BRAINS: [(&str, Agent); 5] = [
    ("avoid", Agent::Avoid),
    ("wall-follow", Agent::WallFollow),
    ("random", Agent::Random),
    ("oracle", Agent::Oracle),
    ("unlocalized-oracle", Agent::UnlocalizedOracle),
];

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let (word, agent) = arguments.brain;
    let name = Name {
        word,
        title: agent.name(),
        nodes: &[],
    };
    let mind = |course: &_, robot: &_| {
        let mind = Cast::default().mind(agent, course, robot);
        mind.map_err(outing::classify)
    };
    send(&arguments.outing, name, mind, out)
}
