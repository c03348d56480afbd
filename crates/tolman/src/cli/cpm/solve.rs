//! `tolman cpm solve`: the second episode, by a map that was kept.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use serde_json::json;
use tolman::agents::cpm::{Errand, Trial, drawing, epuck};
use tolman::draw::Figure;
use tolman_maps::cpm::Done;

use super::{classify, parse, venue};
use crate::cli::failure::OrBadInput;
use crate::cli::{Failure, file, map};

/// Drives an e-puck from the start to the goal by a learned map, and exits 1 if it does not arrive
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman cpm learn --maze mazes/cpm-3.maze --out map.json
  tolman cpm solve --map map.json --maze mazes/cpm-3.maze --seed 7 --svg drive.svg")]
pub(in crate::cli) struct Arguments {
    /// The map, made by `tolman cpm learn`
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// The maze file, of any format, with a start; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// What all chance of the drive follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Draw its way over the map and the maze
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the outcome as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let file = parse(&arguments.map, &map::text(&arguments.map)?)?;
    let venue = venue(&arguments.maze)?;
    let trial = Trial {
        maze: &venue.maze,
        corridor_width: venue.corridor_width,
        patterns: &file.patterns,
        robot: epuck(),
        mode: file.system.mode(),
        seed: arguments.seed,
    };
    let errand = trial
        .drive(file.map)
        .map_err(|error| classify(error, format!("no drive through {}", venue.name)))?;
    let Errand { episode, bumps, .. } = &errand;
    let reached = episode.done == Done::Reached;
    if let Some(path) = &arguments.svg {
        let world = venue.world().or_bad_input()?;
        let drawing = drawing::drive(&errand.map, &venue.maze, &world, &errand.path);
        file::write(
            path,
            &Figure::new("drive", &venue.name, drawing).standalone(),
        )?;
    }
    if arguments.json {
        let json = json!({
            "maze": venue.name,
            "seed": arguments.seed,
            "reached": reached,
            "seconds": episode.seconds,
            "observations": episode.observations,
            "bumps": bumps,
        });
        writeln!(out, "{json:#}")?;
    } else if reached {
        writeln!(
            out,
            "the e-puck reached the goal: {:.0} s, {} observations, {bumps} bumps",
            episode.seconds, episode.observations
        )?;
    }
    if reached {
        return Ok(());
    }
    let elsewhere = if file.maze == venue.name {
        String::new()
    } else {
        format!(", of {}", file.maze)
    };
    Err(Failure::Failed(anyhow!(
        "the e-puck did not arrive in {}: after {:.0} s it was at another place than its map{elsewhere} has there; try another --seed, or learn \
         the map anew",
        venue.name,
        episode.seconds
    )))
}
