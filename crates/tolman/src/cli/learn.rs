//! `tolman learn`: MSLST wanders and learns a map.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use tolman_arena::mslst::learn;
use tolman_arena::pioneer::{LASER_PIONEER, calibrated};
use tolman_systems::Origin;
use tolman_systems::mslst::{MapFile, MslstConfig};

use super::{Failure, OrBadInput, file, run};

/// Lets MSLST wander through a maze, learn its states and its graph, and writes both down
#[derive(clap::Args)]
#[command(after_help = "\
The paper has a threshold of 100 and a memory of 6 for its J maze, 20 or 50 and 8 for its Large one.

Examples:
  tolman learn --maze mazes/j.maze --threshold 100 --memory 6 --out j-map.json
  tolman map show j-map.json --maze mazes/j.maze --svg j-map.svg")]
pub(super) struct Arguments {
    /// The maze file, of any format; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// What all chance follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Phase I: the error threshold of the equilibrium GNG, squared robot units
    #[arg(long, value_name = "ERROR", default_value_t = 50.0)]
    threshold: f64,
    /// Phase I: how long to wander for scans, time steps
    #[arg(long, value_name = "N", default_value_t = MslstConfig::large(50.0).scan_steps, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    steps: u32,
    /// Phase II: how long to wander for the graph, actions
    #[arg(long, value_name = "N", default_value_t = MslstConfig::large(50.0).graph_actions, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    actions: u32,
    /// Phase III: how many pairs of state and action to remember
    #[arg(long, value_name = "N", default_value_t = MslstConfig::large(50.0).memory, value_parser = clap::value_parser!(u32).range(1..=1000))]
    memory: u32,
    /// The file to write the map to
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let course = run::course(&arguments.maze)?;
    let config = MslstConfig {
        scan_steps: arguments.steps,
        graph_actions: arguments.actions,
        memory: arguments.memory,
        ..MslstConfig::large(arguments.threshold)
    };
    let learned = learn(&course, &calibrated(), &config, arguments.seed)
        .context("no map was learned: choose other --threshold or --steps")
        .or_bad_input()?;
    let (states, nodes) = (learned.map.states.models().len(), learned.map.graph.len());
    let map = MapFile {
        origin: Origin {
            world: course.name,
            robot: LASER_PIONEER.to_owned(),
            seed: arguments.seed,
        },
        config,
        learned,
    };
    file::write(&arguments.out, map.to_json()?)?;
    Ok(writeln!(out, "{states} states, a graph of {nodes} nodes")?)
}
