//! `tolman map show`: what a map holds, and a picture of it.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use serde_json::json;
use tolman_arena::diktiometry::SurveyFile;
use tolman_draw::Figure;
use tolman_papers::mslst::drawing;
use tolman_systems::cpm;
use tolman_systems::mslst::MapFile;

use super::{Failure, show_cpm, show_survey};
use crate::cli::{file, run};

/// Tells what a learned map holds, and draws it over the maze
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman map show j-map.json --maze mazes/j.maze --svg j-map.svg
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
    if SurveyFile::is_one(&text) {
        return show_survey::carry_out(arguments, &text, out);
    }
    if !cpm::MapFile::is_one(&text) && !MapFile::is_one(&text) {
        let path = arguments.file.display();
        return Err(Failure::BadInput(anyhow!(
            "{path} is no learned map: make one with `tolman learn`, `tolman cpm learn` or `tolman survey`"
        )));
    }
    if arguments.svg.is_some() && arguments.maze.is_none() {
        let error = anyhow!("this map is drawn over its maze; name that with --maze");
        return Err(Failure::BadInput(error));
    }
    if cpm::MapFile::is_one(&text) {
        return show_cpm::carry_out(arguments, &text, out);
    }
    let map = super::parse(&arguments.file, &text)?;
    if let (Some(maze), Some(path)) = (&arguments.maze, &arguments.svg) {
        let course = run::course(maze)?;
        let drawing = drawing::graph_over_maze(&course, &map.learned);
        let figure = Figure::new("map", &course.name, drawing);
        file::write(path, &figure.standalone())?;
    }
    let MapFile {
        maze,
        seed,
        config,
        learned,
    } = map;
    let graph = &learned.map.graph;
    let destinations = graph.ids().filter(|id| graph.is_destination(*id)).count();
    let furthest = graph.ids().filter_map(|id| graph.distance(id)).max();
    let states = learned.map.states.models().len();
    if arguments.json {
        let json = json!({
            "maze": maze,
            "seed": seed,
            "config": config,
            "states": states,
            "nodes": graph.len(),
            "destination_nodes": destinations,
            "furthest_node": furthest,
        });
        writeln!(out, "{json:#}")?;
        return Ok(());
    }
    writeln!(out, "{maze}, seed {seed}")?;
    writeln!(
        out,
        "{states} states: threshold {}, {} steps",
        config.threshold, config.scan_steps
    )?;
    writeln!(
        out,
        "{} nodes, {destinations} of them in the destination: {} actions",
        graph.len(),
        config.graph_actions
    )?;
    match furthest {
        Some(furthest) => writeln!(out, "the furthest node is {furthest} actions from one")?,
        None => writeln!(out, "no way to the destination is known: learn longer")?,
    }
    Ok(())
}
