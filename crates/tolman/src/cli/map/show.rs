//! `tolman map show`: what a map holds, and a picture of it.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use tolman_systems::MapSystem;

use super::{Failure, show_cpm, show_mslst, show_survey};

/// Tells what a learned map holds, and draws it over the maze
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman learn --maze mazes/j.maze --out j-map.json
  tolman map show j-map.json --maze mazes/j.maze --svg j-map.svg
  tolman survey --maze mazes/j.maze --out j-survey.json
  tolman map show j-survey.json --svg j-survey.svg")]
pub(crate) struct Arguments {
    /// The map, made by `tolman learn`, `tolman cpm learn` or `tolman survey`
    pub(super) file: PathBuf,
    /// The maze it was learned in; a survey knows its own
    #[arg(long, value_name = "FILE", requires = "svg")]
    pub(super) maze: Option<PathBuf>,
    /// Draw the map over the maze
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
    /// Write the figures as JSON
    #[arg(long)]
    pub(super) json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let text = super::text(&arguments.file)?;
    let system = super::parse(&arguments.file, &text, MapSystem::of)?;
    if system != MapSystem::Diktiometry && arguments.svg.is_some() && arguments.maze.is_none() {
        let error = anyhow!("this map is drawn over its maze; name that with --maze");
        return Err(Failure::BadInput(error));
    }
    match system {
        MapSystem::Mslst => show_mslst::carry_out(arguments, &text, out),
        MapSystem::Cpm => show_cpm::carry_out(arguments, &text, out),
        MapSystem::Diktiometry => show_survey::carry_out(arguments, &text, out),
    }
}
