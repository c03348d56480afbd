//! `tolman cpm learn`: a dictionary of common patterns, and a map written in it.

use core::ops::ControlFlow;
use core::sync::atomic::Ordering;
use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use tolman_arena::cpm::{Learned, Progress, Trial, epuck};
use tolman_maze::Cell;
use tolman_robot::Landmark;
use tolman_systems::Origin;
use tolman_systems::cpm::{Aim, CommonPatterns, Done, MapFile, Preset};

use super::{classify, course, learned_patterns};
use crate::cli::bar::bar;
use crate::cli::words::words;
use crate::cli::{Failure, file, interrupt};

/// Lets an e-puck learn common patterns in the learning maze, then a map of a maze, and writes both down
#[derive(clap::Args)]
#[command(after_help = "\
The robot gives up after eight walks for each fragment that the maze has: exit code 1, and no map. A map until explored
that has not as many fragments as the maze is written, and ends in exit code 1 too.

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
    #[arg(long, default_value = "faithful", value_parser = words(SYSTEMS))]
    system: Preset,
    /// When it has learned enough
    #[arg(long, default_value = "goal", value_parser = words(UNTIL))]
    until: Aim,
    /// The file to write the map to
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// The ways of mapping by the names the command line has for them.
const SYSTEMS: [(&str, &str, Preset); 3] = [
    (
        "faithful",
        "As the paper's robot, online: by common patterns alone",
        Preset::Faithful,
    ),
    (
        "better",
        "By dead reckoning too, for fragments that look alike",
        Preset::Better,
    ),
    (
        "unlearned",
        "The same without a learning maze: patterns are learned on the way",
        Preset::Unlearned,
    ),
];

/// When a robot has learned enough.
const UNTIL: [(&str, &str, Aim); 2] = [
    ("goal", "The goal is found", Aim::Find(Landmark::Goal)),
    ("explored", "Every fragment was walked", Aim::Explore),
];

/// What may help where the robot lost itself.
const fn remedy(system: Preset) -> &'static str {
    match system {
        Preset::Faithful => {
            "try --system better, which tells fragments apart that look alike, or another --seed"
        }
        Preset::Better | Preset::Unlearned => "try another --seed",
    }
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let course = course(&arguments.maze)?;
    let (system, aim) = (arguments.system, arguments.until);
    let patterns = match system {
        Preset::Faithful | Preset::Better => learned_patterns(arguments.seed)?,
        Preset::Unlearned => CommonPatterns::none()?,
    };
    let trial = Trial {
        course: &course,
        patterns: &patterns,
        robot: epuck(),
        mode: system.mode(),
        seed: arguments.seed,
    };
    let stop = interrupt::flag()?;
    let template = "{bar:30} {pos} fragments walked, of {len} at most, {msg}";
    let line = bar(trial.patience(), template);
    let learned = trial.learn(aim, |progress| {
        line.set_position(u64::from(progress.walks));
        line.set_message(format!(
            "{} on the map, {:.0} s",
            progress.fragments, progress.seconds
        ));
        match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    line.finish_and_clear();
    let name = &course.name;
    let room = course.room().map(|Cell { x, y }| {
        format!(", which has an open room at cell {x}, {y}, where the robot finds no corridors")
    });
    let room = room.unwrap_or_default();
    let context = format!("no map of {name} was learned{room}");
    let Learned { errand, progress } = match learned {
        Ok(learned) => learned,
        Err(error) => return Err(classify(error, context)),
    };
    if errand.episode.done != Done::Reached {
        let came = came_to_nothing(errand.episode.done, &progress);
        let remedy = remedy(system);
        return Err(Failure::Failed(anyhow!(
            "{context}: the robot {came}; {remedy}"
        )));
    }
    let dictionary = match system {
        Preset::Faithful | Preset::Better => {
            let (units, clusters) = (patterns.unit_count(), patterns.cluster_count());
            format!("a dictionary of {units} units in {clusters} clusters")
        }
        Preset::Unlearned => format!(
            "a dictionary of {} patterns",
            errand.patterns.dictionary().len()
        ),
    };
    let (fragments, junctions) = (errand.map.fragments().len(), errand.map.junctions().len());
    let there_are = trial.true_fragments();
    let file = MapFile {
        origin: Origin {
            world: course.name.clone(),
            robot: "e-puck".to_owned(),
            seed: arguments.seed,
        },
        preset: system,
        patterns: errand.patterns,
        map: errand.map,
    };
    file::write(&arguments.out, file.to_json()?)?;
    if aim == Aim::Explore && fragments != there_are as usize {
        return Err(Failure::Failed(anyhow!(
            "the map in {} is wrong, with {fragments} for the {there_are} fragments of {}{room}: the robot took some for others, or overlooked \
             them; {}",
            arguments.out.display(),
            file.origin.world,
            remedy(system)
        )));
    }
    writeln!(
        out,
        "{dictionary}; a map of {fragments} fragments and {junctions} junctions, learned in {:.0} s",
        errand.episode.seconds
    )?;
    Ok(())
}

/// How a walk ended that taught no map.
fn came_to_nothing(done: Done, progress: &Progress) -> String {
    let Progress {
        walks,
        untried,
        recognized,
        fragments,
        seconds,
    } = progress;
    let gave_up = match done {
        Done::OutOfPatience => "gave up",
        Done::NotThere => "took a place for another, and found no goal where its map ends,",
        Done::Reached => "came to its end",
    };
    format!(
        "{gave_up} after {seconds:.0} s: {walks} fragments walked, {fragments} on the map, {recognized} of {untried} untried ways recognized"
    )
}
