//! `tolman map show` of a map of MSLST.

use std::io::Write;

use serde_json::json;
use tolman_draw::Figure;
use tolman_papers::mslst::drawing;
use tolman_systems::Origin;
use tolman_systems::mslst::MapFile;

use super::show::Arguments;
use crate::cli::{Failure, file, run};

pub(super) fn carry_out(
    arguments: &Arguments,
    text: &str,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let map = super::parse(&arguments.file, text, MapFile::from_json)?;
    if let (Some(maze), Some(path)) = (&arguments.maze, &arguments.svg) {
        let course = run::course(maze)?;
        let drawing = drawing::graph_over_maze(&course, &map.learned);
        let figure = Figure::new("map", &course.name, drawing);
        file::write(path, figure.standalone())?;
    }
    let MapFile {
        origin: Origin { world, seed, .. },
        config,
        learned,
    } = map;
    let graph = &learned.map.graph;
    let destinations = graph.ids().filter(|id| graph.is_destination(*id)).count();
    let furthest = graph.ids().filter_map(|id| graph.distance(id)).max();
    let states = learned.map.states.models().len();
    if arguments.json {
        let json = json!({
            "maze": world,
            "seed": seed,
            "config": config,
            "states": states,
            "nodes": graph.len(),
            "destination_nodes": destinations,
            "furthest_node": furthest,
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    writeln!(out, "{world}, seed {seed}")?;
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
