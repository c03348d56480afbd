//! `tolman cpm learn`: a dictionary of common patterns, and a map written in it.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use clap::ValueEnum;
use tolman::agents::cpm::{MapFile, System, Trial, Venue, epuck, learn};
use tolman_maps::cpm::{Aim, Done, Landmark};

use super::venue;
use crate::cli::failure::OrBadInput;
use crate::cli::{Failure, file};

/// Lets an e-puck learn common patterns in the learning maze, then a map of a maze, and writes both down
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman cpm learn --maze mazes/cpm-3.maze --out map.json
  tolman map show map.json --maze mazes/cpm-3.maze --svg map.svg
  tolman cpm solve --map map.json --maze mazes/cpm-3.maze --svg drive.svg")]
pub(in crate::cli) struct Arguments {
    /// The maze file, of any format, with a start; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// What all chance follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How it maps
    #[arg(long, value_enum, default_value_t = Choice::Faithful)]
    system: Choice,
    /// When it has learned enough
    #[arg(long, value_enum, default_value_t = Until::Goal)]
    until: Until,
    /// The file to write the map to
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Choice {
    /// As the paper's robot, online: by common patterns alone
    Faithful,
    /// By dead reckoning too, for fragments that look alike
    Better,
}

#[derive(Clone, Copy, ValueEnum)]
enum Until {
    /// The goal is found
    Goal,
    /// Every fragment was walked
    Explored,
}

/// Where the common patterns are learned.
pub(super) const LEARNING_MAZE: &str = include_str!("../../../../../mazes/cpm-learning.maze");

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let venue = venue(&arguments.maze)?;
    let learning = Venue::new("", tolman_maze::read(LEARNING_MAZE)?)?;
    let patterns = learn(&learning.maze, learning.corridor_width, arguments.seed)?;
    let system = match arguments.system {
        Choice::Faithful => System::Faithful,
        Choice::Better => System::Better,
    };
    let trial = Trial {
        maze: &venue.maze,
        corridor_width: venue.corridor_width,
        patterns: &patterns,
        robot: epuck(),
        mode: system.mode(),
        seed: arguments.seed,
    };
    let aim = match arguments.until {
        Until::Goal => Aim::Find(Landmark::Goal),
        Until::Explored => Aim::Explore,
    };
    let errand = trial
        .learn(aim)
        .with_context(|| format!("no map of {} was learned", venue.name))
        .or_bad_input()?;
    match errand.episode.done {
        Done::Reached => {}
        Done::NotThere => {
            let error = anyhow!(
                "the robot found no goal in {}: is it walled off?",
                venue.name
            );
            return Err(error).or_bad_input();
        }
        Done::OutOfPatience => {
            let error = anyhow!("the robot gave up in {}: try another --seed", venue.name);
            return Err(error).or_bad_input();
        }
    }
    let (units, clusters) = (patterns.unit_count(), patterns.cluster_count());
    let (fragments, junctions) = (errand.map.fragments().len(), errand.map.junctions().len());
    let file = MapFile {
        maze: venue.name,
        seed: arguments.seed,
        system,
        patterns,
        map: errand.map,
    };
    file::write(&arguments.out, &file.to_json()?)?;
    writeln!(
        out,
        "a dictionary of {units} units in {clusters} clusters; a map of {fragments} fragments and {junctions} junctions, learned in {:.0} s",
        errand.episode.seconds
    )?;
    Ok(())
}
