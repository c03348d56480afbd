//! `tolman cpm solve`: the second episode, by a map that was kept, from the start or from anywhere.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use serde_json::json;
use tolman_arena::course::Course;
use tolman_arena::cpm::{DriveFrom, Errand, Trial, epuck};
use tolman_draw::Figure;
use tolman_geom::Pose;
use tolman_maps::cpm::CpMap;
use tolman_papers::cpm::drawing;
use tolman_systems::cpm::Done;
use tolman_systems::cpm::MapFile;

use super::{classify, course};
use crate::cli::start::Start;
use crate::cli::{Failure, OrBadInput, file, map};

/// Drives an e-puck to the goal by learned maps, and exits 1 if it does not arrive
///
/// With one map it is told that it stands at the start. Elsewhere, or with maps of several mazes, it finds out where it is: it drives on
/// until the next junction, dead end, start or goal comes into sight, turns round there if it is not sure yet, and goes on until it is.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman cpm learn --maze mazes/cpm-3.maze --until explored --out map.json
  tolman cpm solve --map map.json --maze mazes/cpm-3.maze --seed 7 --svg drive.svg
  tolman cpm learn --maze mazes/cpm-2.maze --until explored --out other.json
  tolman cpm solve --map map.json --map other.json --maze mazes/cpm-3.maze --start random")]
pub(in crate::cli) struct Arguments {
    /// A map, made by `tolman cpm learn`; once for each maze that the robot knows, all learned with one --seed
    #[arg(long, value_name = "FILE", required = true)]
    map: Vec<PathBuf>,
    /// The maze file, of any format, with a start; - reads standard input
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// Where the robot is put down: marked (where the maze says), random, or X,Y or X,Y,DEG in metres and degrees from the
    /// south-west corner, counter-clockwise from east
    #[arg(long, value_name = "WHERE", default_value = "marked")]
    start: Start,
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

/// What the robot found out about where it is.
struct Found {
    /// The map, by its place among those given.
    map: usize,
    probability: f64,
    /// How many junctions, dead ends, starts and goals it came to before it was sure.
    places: usize,
    turned_round: bool,
}

impl Found {
    fn of(drive: &DriveFrom) -> Self {
        let found = &drive.found;
        Self {
            map: drive.believed.map,
            probability: drive.believed.probability,
            places: found.iter().map(|found| found.at_places.len()).sum(),
            turned_round: found.iter().any(|found| found.has_turned_round),
        }
    }
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let files = files(&arguments.map)?;
    let Some(first) = files.first() else {
        return Err(Failure::BadInput(anyhow!("no map is given: add --map")));
    };
    let course = course(&arguments.maze)?;
    let trial = Trial {
        course: &course,
        patterns: &first.patterns,
        robot: epuck(),
        mode: first.preset.mode(),
        seed: arguments.seed,
    };
    let maps: Vec<CpMap> = files.iter().map(|file| file.map.clone()).collect();
    let driven = match (&maps[..], arguments.start) {
        ([map], Start::Marked) => trial.drive(map.clone()).map(|errand| (None, errand)),
        (maps, start) => {
            let start = pose(start, &course, arguments.seed)?;
            let drive = trial.drive_from(maps, start);
            drive.map(|drive| (Some(Found::of(&drive)), drive.errand))
        }
    };
    let (found, errand) =
        driven.map_err(|error| classify(error, format!("no drive through {}", course.name)))?;
    let Errand { episode, bumps, .. } = &errand;
    let reached = episode.done == Done::Reached;
    if let Some(path) = &arguments.svg {
        let drawing = drawing::drive(&errand.map, &course, &errand.path);
        file::write(
            path,
            Figure::new("drive", &course.name, drawing).standalone(),
        )?;
    }
    let learned_in = |map: usize| files.get(map).map_or("", |file| file.origin.world.as_str());
    if arguments.json {
        let found = found.as_ref().map(|found| {
            json!({
                "map": arguments.map.get(found.map),
                "maze": learned_in(found.map),
                "probability": found.probability,
                "places": found.places,
                "turned_round": found.turned_round,
            })
        });
        let json = json!({
            "maze": course.name,
            "seed": arguments.seed,
            "reached": reached,
            "seconds": episode.seconds,
            "observations": episode.observations,
            "bumps": bumps,
            "found": found,
        });
        writeln!(out, "{json:#}")?;
    } else {
        if let Some(found) = &found {
            writeln!(out, "{}", told(found, learned_in(found.map)))?;
        }
        if reached {
            writeln!(
                out,
                "the e-puck reached the goal: {:.0} s, {} observations, {bumps} bumps",
                episode.seconds, episode.observations
            )?;
        }
    }
    if reached {
        return Ok(());
    }
    let by = learned_in(found.map_or(0, |found| found.map));
    let elsewhere = if by == course.name {
        String::new()
    } else {
        format!(", of {by},")
    };
    Err(Failure::Failed(anyhow!(
        "the e-puck did not arrive in {}: after {:.0} s it was at another place than its map{elsewhere} has there; try another --seed, or learn \
         the map anew",
        course.name,
        episode.seconds
    )))
}

/// Where the robot is put down.
///
/// # Errors
/// Bad input if there is nowhere.
fn pose(start: Start, course: &Course, seed: u64) -> Result<Pose, Failure> {
    match start {
        Start::Marked => course.start().or_bad_input(),
        Start::Random => course
            .anywhere(seed)
            .ok_or_else(|| anyhow!("{} has no way to a goal", course.name))
            .or_bad_input(),
        Start::At(pose) => Ok(pose),
    }
}

/// Reads maps that are written in the same patterns.
///
/// # Errors
/// Bad input with the file's name.
fn files(paths: &[PathBuf]) -> Result<Vec<MapFile>, Failure> {
    let files: Result<Vec<MapFile>, Failure> = paths
        .iter()
        .map(|path| map::read(path, MapFile::from_json))
        .collect();
    let files = files?;
    let version = |file: &MapFile| file.patterns.dictionary().version();
    for (path, file) in paths.iter().zip(&files) {
        if files.first().map(version) != Some(version(file)) {
            return Err(Failure::BadInput(anyhow!(
                "{} is written in other patterns than {}: learn both with the same --seed, and with --system faithful or better",
                path.display(),
                paths[0].display()
            )));
        }
    }
    Ok(files)
}

/// What it found out, in words.
fn told(found: &Found, maze: &str) -> String {
    let percent = 100.0 * found.probability;
    let places = match found.places {
        1 => "1 place".to_owned(),
        places => format!("{places} places"),
    };
    let turned = if found.turned_round {
        ", having turned round once"
    } else {
        ""
    };
    format!("put down, it was {percent:.1} % sure that this is {maze} after {places}{turned}")
}
