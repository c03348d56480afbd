//! `tolman map show` of a survey.

use std::io::Write;

use anyhow::anyhow;
use serde_json::json;
use tolman_arena::diktiometry::SurveyFile;
use tolman_draw::Figure;
use tolman_maps::diktiometry::{Link, PlaceId};
use tolman_papers::diktiometry::drawing::map_over_world;
use tolman_sim::Bounds;

use super::show::Arguments;
use crate::cli::{Failure, OrBadInput, file};

/// A survey's map: its places with where they lie as seen from the start, and its links.
pub(super) fn carry_out(
    arguments: &Arguments,
    text: &str,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let read = super::parse(&arguments.file, text, SurveyFile::from_json)?;
    if let Some(maze) = &arguments.maze {
        let maze = maze.display();
        let error = anyhow!("a survey knows its own maze; leave --maze {maze} out");
        return Err(Failure::BadInput(error));
    }
    // Chance has no part in looking.
    let survey = read.survey(0).or_bad_input()?;
    if let Some(path) = &arguments.svg {
        let drawing = map_over_world(&read.office, &survey);
        let figure = Figure::new("map", &read.origin.world, drawing);
        file::write(path, figure.standalone())?;
    }
    let score = survey.score();
    let paths = &read.observer.map().paths;
    let here = read.observer.place();
    let drawn = survey.drawn();
    let direction = |link: &Link| super::way(link.action);
    let links_of = |id: u32| paths.outgoing(PlaceId(id)).map(|(_, link)| link);
    if arguments.json {
        let places: Vec<serde_json::Value> = drawn
            .iter()
            .map(|place| {
                let Bounds { min, max } = place.bounds;
                let links: Vec<serde_json::Value> = links_of(place.id)
                    .map(|link| json!({ "action": direction(link), "to": link.to.0, "traversed": link.traversed }))
                    .collect();
                json!({
                    "id": place.id,
                    "box": { "west": min.x, "south": min.y, "east": max.x, "north": max.y },
                    "visits": paths.place(PlaceId(place.id)).map(|place| place.visits),
                    "links": links,
                })
            })
            .collect();
        let json = json!({
            "maze": read.origin.world,
            "moves": read.observer.moves(),
            "here": here.0,
            "true_places": score.visited,
            "purity": score.purity,
            "link_precision": score.link_precision,
            "places": places,
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    writeln!(
        out,
        "{}, {} moves: {} places for {} true ones, purity {:.3}; the robot is at place {}",
        read.origin.world,
        read.observer.moves(),
        score.places,
        score.visited,
        score.purity,
        here.0
    )?;
    for place in &drawn {
        let ways: Vec<String> = links_of(place.id)
            .map(|link| format!("{} to {}", direction(link), link.to.0))
            .collect();
        writeln!(out, "{}: {}", place.label, ways.join(", "))?;
    }
    Ok(())
}
