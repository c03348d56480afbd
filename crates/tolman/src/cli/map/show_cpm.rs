//! `tolman map show` of a common-pattern map.

use std::io::Write;

use anyhow::anyhow;
use serde_json::json;
use tolman_draw::Figure;
use tolman_papers::cpm::drawing;
use tolman_robot::Landmark;
use tolman_systems::Origin;
use tolman_systems::cpm::MapFile;

use super::show::Arguments;
use crate::cli::maze::name as maze_name;
use crate::cli::{Failure, cpm, file};

pub(super) fn carry_out(
    arguments: &Arguments,
    text: &str,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let read = super::parse(&arguments.file, text, MapFile::from_json)?;
    let MapFile {
        origin: Origin { world, seed, .. },
        preset,
        patterns,
        map,
    } = &read;
    if let (Some(maze), Some(path)) = (&arguments.maze, &arguments.svg) {
        let course = cpm::course(maze)?;
        if course.name != *world && course.name != maze_name(maze) {
            return Err(Failure::BadInput(anyhow!(
                "{} is a map of {world}, and {} says that it is {}: name the maze that the map was learned in",
                arguments.file.display(),
                maze.display(),
                course.name
            )));
        }
        let drawing = drawing::over_maze(map, &course);
        file::write(path, Figure::new("map", &course.name, drawing).standalone())?;
    }
    let (units, clusters) = (patterns.unit_count(), patterns.cluster_count());
    let (fragments, junctions) = (map.fragments().len(), map.junctions().len());
    let unexplored = map.open_ports().count();
    let is_goal = |junction| map.has(junction, Landmark::Goal);
    let plan = map.start().and_then(|from| map.plan(from, is_goal));
    let length = plan.map(|plan| plan.length);
    if arguments.json {
        let json = json!({
            "maze": world,
            "seed": seed,
            "preset": preset,
            "units": units,
            "clusters": clusters,
            "fragments": fragments,
            "junctions": junctions,
            "unexplored_ports": unexplored,
            "observations_to_goal": length,
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    writeln!(out, "{world}, seed {seed}")?;
    writeln!(out, "{units} units in {clusters} clusters")?;
    writeln!(
        out,
        "{fragments} fragments, {junctions} junctions, {unexplored} ports nobody has been through"
    )?;
    match length {
        Some(length) => writeln!(out, "the goal is {length} observations from the start")?,
        None => writeln!(out, "no way to the goal is known: learn until it is found")?,
    }
    Ok(())
}
