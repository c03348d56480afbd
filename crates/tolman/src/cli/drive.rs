//! `tolman drive`: a robot drives to the goal by a learned map.

use core::fmt;
use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_geom::Point;

use super::looks::Looks;
use super::map::map_text;
use super::send::{ARRIVE, Pursued, check_origin, send};
use super::sent_out::SentOut;
use super::unfinished::{GoingOn, checksum};
use super::{App, Failure, OrBadInput, Result, Unboxed};
use tolman_arena::Outing;
use tolman_arena::registry::{MapText, Schooling, Start};
use tolman_geom::path_length;

/// Sends a robot to the goal of a maze or a world by a learned map; exits 1 if it does not arrive
///
/// The robot localizes, drives, and plans again where the world differs from the map. Given maps of
/// several mazes, it finds out which one fits.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman learn --system cpm-better --maze mazes/cpm-3.maze --out map.json
  tolman drive --map map.json --maze mazes/cpm-3.maze --seed 7 --replay drive.html
  tolman learn --system cpm-better --maze mazes/cpm-2.maze --out other.json
  tolman drive --map map.json --map other.json --maze mazes/cpm-3.maze
  tolman learn --system cpm-better --robot laser-pioneer --world mazes/worlds/corridors.json --out corridors-map.json
  tolman drive --map corridors-map.json --world mazes/worlds/corridors.json --seed 2
  tolman learn --system gng-slam-better --world mazes/worlds/pitch.json --out pitch-map.json --replay learned.html
  tolman drive --map pitch-map.json --world mazes/worlds/pitch.json --seed 7 --replay drive.html

Ctrl-C saves the drive; --from FILE continues it, bit for bit as if it had not been interrupted.")]
pub(super) struct Arguments {
    /// Map file, written by `tolman learn`; may be given several times, if the system can tell maps
    /// apart
    #[arg(long, value_name = "FILE", required = true)]
    map: Vec<PathBuf>,
    #[command(flatten)]
    sent_out: SentOut,
    /// Drive even if the map is of another maze or another robot
    #[arg(long)]
    anyway: bool,
    #[command(flatten)]
    going_on: GoingOn,
    #[command(flatten)]
    looks: Looks,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let maps: Result<Vec<MapText>> = arguments.map.iter().map(|path| map_text(path)).collect();
    let maps = maps?;
    let system = app.system_of(&maps[0])?;
    for map in &maps {
        let other = app.system_of(map)?;
        if other.name() != system.name() {
            return Err(Failure::BadInput(anyhow!(
                "{} is a map of {}, and {} one of {}: give maps of one system",
                maps[0].name,
                system.name(),
                map.name,
                other.name()
            )));
        }
    }
    arguments.sent_out.refuse_preset()?;
    let terrain = arguments.sent_out.terrain()?;
    let schooling = Schooling::default();
    let learner = &maps[0].origin.robot;
    let robot = arguments.sent_out.robot(app, system, learner)?;
    let mut setup = arguments.sent_out.setup(&terrain, robot, &schooling);
    setup.start = setup.start.or(Some(Start::Random));
    let context = || {
        let context = format!("{} cannot drive in {}", system.name(), setup.world);
        let mut origins = maps.iter().map(|map| &map.origin.world);
        match origins.all(|world| world != setup.world) {
            true => format!(
                "{context}, and the map in {} was learned in {}",
                maps[0].name, maps[0].origin.world
            ),
            false => context,
        }
    };
    let outing = system.driver(&maps, &setup);
    let mut outing = outing.unboxed().with_context(context).or_bad_input()?;
    if !arguments.anyway {
        let mut checked = maps.iter().map(|map| check_origin(map, &*outing));
        if !checked.any(|checked| checked.is_ok()) {
            check_origin(&maps[0], &*outing)?;
        }
    }
    let texts: String = maps.iter().map(|map| &*map.text).collect();
    let call = arguments.sent_out.call("drive", system.name(), &*outing);
    let call = call
        .with("the checksum of the maps", Some(checksum(&texts)))
        .with("--anyway", arguments.anyway.then_some("given"));
    let keeper = arguments.going_on.keeper(call)?;
    if !arguments.looks.json {
        let how = match setup.start {
            Some(Start::Random) => "put down at random",
            _ => "put down",
        };
        writeln!(out, "{} is {how}, {}", system.name(), place(&*outing))?;
    }
    let Pursued {
        ended,
        told,
        has_arrived,
        saved,
    } = send(
        &mut *outing,
        ARRIVE,
        &setup,
        system.name(),
        &arguments.looks,
        keeper,
        |_, _| {},
    )?;
    saved.remove();
    let way = Way::of(&*outing);
    let json = || {
        json!({
            "system": system.name(),
            "maze": setup.world,
            "seed": setup.seed,
            "map": maps[outing.chosen()].name,
            "reached": has_arrived,
            "steps": ended.steps,
            "actions": ended.actions,
            "bumps": outing.bumped().len(),
            "metres": way.driven,
            "shortest_metres": way.shortest,
        })
    };
    arguments.looks.tell(out, json, |out| {
        if let (true, Some(map)) = (maps.len() > 1, maps.get(outing.chosen())) {
            writeln!(out, "{} is taken for the map of this maze", map.name)?;
        }
        match has_arrived {
            true => writeln!(out, "{told}\nIt is at the goal: {way}"),
            false => Ok(()),
        }
    })?;
    match has_arrived {
        true => Ok(()),
        false => Err(Failure::Failed(anyhow!(
            "{told}: the robot is not at the goal of {}",
            setup.world
        ))),
    }
}

/// Returns the cell of a maze in which a robot is, or its position in a world, in words.
fn place(outing: &dyn Outing) -> String {
    let at = outing
        .path()
        .last()
        .map_or_else(Point::origin, |pose| pose.position);
    let course = outing.course();
    match course.world.cell_at(at).filter(|_| !course.is_free()) {
        Some(cell) => format!("in cell {cell}"),
        None => format!("at ({:.2}, {:.2}) m", at.x, at.y),
    }
}

/// Length of the way to the goal, m.
struct Way {
    /// Distance driven until the robot first was at the goal.
    driven: f64,
    /// Length of a shortest way from where it started; `None` if none was found.
    shortest: Option<f64>,
}

impl Way {
    fn of(outing: &dyn Outing) -> Self {
        let (course, path) = (outing.course(), outing.path());
        let there = path
            .iter()
            .position(|pose| course.is_destination(pose.position));
        let driven = path_length(&path[..there.map_or(path.len(), |there| there + 1)]);
        let start = path.first().map(|pose| pose.position);
        let shortest =
            start.and_then(|start| course.shortest_drive(start, outing.robot().inner_radius()));
        // The way it drove is one, too: the search is as fine as its grid.
        let shortest = shortest.map(|shortest| match there {
            Some(_) => shortest.min(driven),
            None => shortest,
        });
        Self { driven, shortest }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "it drove {:.1} m", self.driven)?;
        match self.shortest {
            Some(shortest) => write!(f, ", and the shortest way is {shortest:.1} m"),
            None => Ok(()),
        }
    }
}
