//! `tolman systems`: lists the systems.

use std::io::Write;

use serde_json::{Value, json};
use tolman_arena::registry::{RobotEntry, SystemEntry};

use super::{App, Result};

/// Lists the systems, with their presets and their robots
#[derive(clap::Args)]
#[command(after_help = "\
A system that learns can be given to learn, demo and arena; one that drives also to drive; one that maps logs to map --log.
A baseline only drives to the goal: run and arena.

Examples:
  tolman systems
  tolman systems --json")]
pub(super) struct Arguments {
    /// Write JSON: systems and robots, all that is known of each
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let registry = app.registry();
    if arguments.json {
        let systems = registry.systems.iter().map(|system| json_of(app, *system));
        let robots = registry.robots.iter().map(|robot| {
            let RobotEntry {
                name, title, about, ..
            } = robot;
            json!({ "name": name, "title": title, "about": about, "senses": robot.kind().senses() })
        });
        let json = json!({
            "systems": systems.collect::<Vec<Value>>(),
            "robots": robots.collect::<Vec<Value>>(),
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    for system in &registry.systems {
        let uses = uses(*system).join(", ");
        let facts = system.facts();
        writeln!(out, "{}: {} ({uses})", facts.name, facts.about)?;
        for (name, about) in facts.presets {
            writeln!(out, "    --preset {name:<14} {about}")?;
        }
        for robot in registry.robots_of(*system) {
            if facts.learns {
                writeln!(out, "    --robot {}", robot.name)?;
            }
        }
    }
    for robot in &registry.robots {
        writeln!(out, "--robot {}: {}", robot.name, robot.about)?;
    }
    Ok(())
}

/// Returns what a system can be used for.
fn uses(system: &dyn SystemEntry) -> Vec<&'static str> {
    let facts = system.facts();
    let all = [
        (facts.learns, "learns"),
        (facts.drives, "drives"),
        (facts.log_mapper.is_some(), "maps logs"),
        (facts.baseline.is_some(), "baseline"),
    ];
    let is = all.into_iter().filter(|(is, _)| *is);
    is.map(|(_, word)| word).collect()
}

fn json_of(app: &App, system: &dyn SystemEntry) -> Value {
    let facts = system.facts();
    let presets = facts.presets.iter();
    let presets = presets.map(|(name, about)| json!({ "name": name, "about": about }));
    let robots = app.registry().robots_of(system);
    let names: Vec<&str> = robots.iter().map(|robot| robot.name).collect();
    let others = app.registry().robots.iter();
    let refused =
        others.filter_map(|robot| Some((robot.name.to_owned(), system.why_not(robot)?.into())));
    json!({
        "name": facts.name,
        "title": facts.title,
        "about": facts.about,
        "paper": facts.is_paper,
        "learns": facts.learns,
        "drives": facts.drives,
        "maps_logs": facts.log_mapper.is_some(),
        "baseline": facts.baseline.is_some(),
        "presets": presets.collect::<Vec<Value>>(),
        "robots": names,
        "why_not": refused.collect::<serde_json::Map<String, Value>>(),
    })
}
