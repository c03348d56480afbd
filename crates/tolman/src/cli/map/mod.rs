//! `tolman map`: estimates the trajectory of a robot from its log, and shows learned maps.

mod log;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Subcommand;
use tolman_draw::Figure;

use crate::cli::ground::{Ground, required};
use crate::cli::kind::Kind;
use crate::cli::outputs::{self, Output};
use crate::cli::{App, Failure, OrBadInput, Result, Unboxed, file};
use tolman_arena::registry::{LearnedMap, MapText};

/// Makes a map from a robot's log of laser scans; with a subcommand, shows, checks or plans on a
/// learned map
#[derive(clap::Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true,
    after_help = log::EXAMPLES
)]
pub(in crate::cli) struct Arguments {
    #[command(subcommand)]
    verb: Option<Verb>,
    #[command(flatten)]
    log: log::Arguments,
}

impl Arguments {
    pub(in crate::cli) fn carry_out(self, app: &App, out: &mut dyn Write) -> Result {
        match self.verb {
            Some(verb) => verb.carry_out(app, out),
            None => log::carry_out(app, &self.log, out),
        }
    }
}

/// Verbs for a learned map
#[derive(Subcommand)]
enum Verb {
    Show(Show),
    Plan(Plan),
    Check(Check),
}

/// Describes a learned map, and draws it over the maze
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman learn --system cpm-better --maze mazes/cpm-1.maze --out map.json
  tolman map show map.json --maze mazes/cpm-1.maze --svg map.svg")]
pub(in crate::cli) struct Show {
    /// Map file, written by `tolman learn`
    file: PathBuf,
    #[command(flatten)]
    ground: Ground,
    /// Draw the map over its maze or world, which must be given as well
    #[arg(long, value_name = "FILE", requires = "ground", value_parser = outputs::file(&["svg"]))]
    svg: Option<Output>,
    /// Write the figures as JSON
    #[arg(long)]
    json: bool,
}

/// Plans a path over a learned map, from place to place or to the goal; exits 1 if none is known
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman learn --system diktiometry-better --maze mazes/j-long.maze --out j-survey.json
  tolman map plan j-survey.json --from 0 --to 3")]
pub(in crate::cli) struct Plan {
    /// Map file, written by `tolman learn`
    file: PathBuf,
    /// Number of the place to go to, instead of the goal
    #[arg(long, value_name = "PLACE")]
    to: Option<u32>,
    /// Number of the place to begin at, instead of the robot's place
    #[arg(long, value_name = "PLACE")]
    from: Option<u32>,
}

/// Compares a learned map with the maze; exits 1 if it is wrong or unfinished
#[derive(clap::Args)]
#[command(
    group(required()),
    after_help = "\
Example:
  tolman learn --system cpm-better --maze mazes/cpm-1.maze --out map.json
  tolman map check map.json --maze mazes/cpm-1.maze"
)]
pub(in crate::cli) struct Check {
    /// Map file, written by `tolman learn`
    file: PathBuf,
    #[command(flatten)]
    ground: Ground,
}

impl Verb {
    fn carry_out(self, app: &App, out: &mut dyn Write) -> Result {
        match self {
            Self::Show(arguments) => show(app, &arguments, out),
            Self::Plan(arguments) => plan(app, &arguments, out),
            Self::Check(arguments) => check(app, &arguments, out),
        }
    }
}

fn show(app: &App, arguments: &Show, out: &mut dyn Write) -> Result {
    let (text, map) = read(app, &arguments.file)?;
    if let Some(path) = &arguments.svg {
        let (world, terrain) = arguments.ground.read()?;
        let drawing = map.drawing(&terrain).unboxed();
        let drawing = drawing.map_err(|error| match world == text.origin.world {
            true => error,
            false => error.context(format!(
                "the map in {} was learned in {}, and this is {world}",
                text.name, text.origin.world
            )),
        });
        let drawing = drawing.or_bad_input()?;
        let figure = Figure::new("map", &text.origin.world, drawing);
        file::write(path, figure.standalone())?;
    }
    if arguments.json {
        return Ok(writeln!(out, "{:#}", map.json())?);
    }
    for line in map.lines() {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

fn plan(app: &App, arguments: &Plan, out: &mut dyn Write) -> Result {
    let (_, map) = read(app, &arguments.file)?;
    let plan = map.plan(arguments.from, arguments.to);
    let plan = plan.unboxed().or_bad_input()?;
    let Some(lines) = plan else {
        return Err(Failure::Failed(anyhow!(
            "no way is known on the map in {}",
            arguments.file.display()
        )));
    };
    if lines.is_empty() {
        writeln!(out, "the plan ends where it begins")?;
    }
    for line in lines {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

fn check(app: &App, arguments: &Check, out: &mut dyn Write) -> Result {
    let text = map_text(&arguments.file)?;
    let system = app.system_of(&text)?;
    let (_, terrain) = arguments.ground.read()?;
    let complaint = text.complaint(system, &terrain);
    match complaint.unboxed().or_bad_input()? {
        None => Ok(writeln!(out, "{} is right", text.name)?),
        Some(complaint) => Err(Failure::Failed(anyhow!(
            "the map in {} is wrong or unfinished: {complaint}",
            text.name
        ))),
    }
}

fn read(app: &App, path: &Path) -> Result<(MapText, Box<dyn LearnedMap>)> {
    let text = map_text(path)?;
    let map = app.system_of(&text)?.map(&text);
    let map = map.unboxed().or_bad_input()?;
    Ok((text, map))
}

/// Returns the text of a learned map's file, of any system.
///
/// # Errors
/// Bad input with the file's name.
pub(in crate::cli) fn map_text(path: &Path) -> Result<MapText> {
    of_text(path, &text(path)?)
}

/// Returns the text of a file that should hold a learned map.
///
/// # Errors
/// Bad input with the file's name.
pub(in crate::cli) fn text(path: &Path) -> Result<String> {
    file::read(path, "give a file that `tolman learn` wrote")
}

/// Returns `text` as that of a learned map's file.
///
/// # Errors
/// Bad input with the file's name.
pub(in crate::cli) fn of_text(path: &Path, text: &str) -> Result<MapText> {
    let name = path.display().to_string();
    MapText::read(name.clone(), text.to_owned())
        .map_err(|error| Kind::Map.explain(text, &name, error))
        .or_bad_input()
}
