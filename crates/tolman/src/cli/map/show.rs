//! `tolman map show`: what a map holds, and a picture of it.

use std::io::Write;
use std::path::PathBuf;

use serde_json::json;
use tolman::agents::cpm;
use tolman::agents::mslst::{MapFile, drawing};
use tolman::draw::Figure;

use super::{Failure, show_cpm};
use crate::cli::{file, run};

/// Tells what a learned map holds, and draws its graph over the maze
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman map show j-map.json --maze mazes/j.maze --svg j-map.svg")]
pub(crate) struct Arguments {
    /// The map, made by `tolman learn` or `tolman cpm learn`
    pub(super) file: PathBuf,
    /// The maze it was learned in
    #[arg(long, value_name = "FILE", requires = "svg")]
    pub(super) maze: Option<PathBuf>,
    /// Draw the graph over the maze
    #[arg(long, value_name = "FILE", requires = "maze")]
    pub(super) svg: Option<PathBuf>,
    /// Write the figures as JSON
    #[arg(long)]
    pub(super) json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let text = super::text(&arguments.file)?;
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
