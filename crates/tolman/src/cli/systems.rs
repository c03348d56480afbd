//! `tolman systems`: lists the systems.

use alloc::collections::BTreeMap;
use std::io::Write;

use anyhow::Context;
use serde_json::{Value, json};
use tolman_arena::registry::{AllSettings, DrivesBy, RobotEntry, Schooling, Settings, SystemEntry};

use super::demo::MAZE;
use super::sent_out::setup_of;
use super::{App, Result};

/// Lists the systems, with their presets and their robots
#[derive(clap::Args)]
#[command(after_help = "\
A system that learns can be given to learn, demo and arena; one that drives also to drive; one that maps logs to map --log.
A baseline only drives to the goal: run and arena.

With NAME, its settings are listed, too: for each the value that --set of learn and drive replaces. Some depend on the
size of the world; then the value is that in the maze of `tolman demo`.

Examples:
  tolman systems
  tolman systems mslst-better
  tolman systems --json")]
pub(super) struct Arguments {
    /// Only this system, with its settings
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Write JSON: systems and robots, all that is known of each
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let registry = app.registry();
    let named = match &arguments.name {
        Some(name) => Some(app.system(name, |_| true)?),
        None => None,
    };
    let systems = registry.systems.iter().copied();
    let systems = systems.filter(|system| named.is_none_or(|named| named == *system));
    if arguments.json {
        let systems = systems.map(|system| json_of(app, system));
        let robots = registry.robots.iter().map(|robot| {
            let RobotEntry {
                name, title, about, ..
            } = robot;
            json!({ "name": name, "title": title, "about": about, "senses": robot.kind().senses() })
        });
        let json = json!({
            "systems": systems.collect::<Result<Vec<Value>>>()?,
            "robots": robots.collect::<Vec<Value>>(),
        });
        return Ok(writeln!(out, "{json:#}")?);
    }
    for system in systems {
        let uses = uses(system).join(", ");
        let facts = system.facts();
        writeln!(out, "{}: {} ({uses})", facts.name, facts.about)?;
        for (number, (name, about)) in facts.presets.iter().enumerate() {
            let default = if number == 0 { " [default]" } else { "" };
            writeln!(out, "    --preset {name:<14} {about}{default}")?;
        }
        for robot in registry.robots_of(system) {
            if facts.learns {
                writeln!(out, "    --robot {}", robot.name)?;
            }
        }
    }
    if let Some(system) = named {
        for (name, value) in settings(app, system)? {
            writeln!(out, "    --set {name}={value}")?;
        }
        return Ok(());
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
        (facts.drives == DrivesBy::AnyMap, "drives"),
        (facts.log_mapper.is_some(), "maps logs"),
        (facts.baseline.is_some(), "baseline"),
    ];
    let is = all.into_iter().filter(|(is, _)| *is);
    is.map(|(_, word)| word).collect()
}

/// Returns the settings of a system by its default preset, by name.
fn settings(app: &App, system: &dyn SystemEntry) -> Result<BTreeMap<String, toml::Value>> {
    if !system.learns() {
        return Ok(BTreeMap::new());
    }
    let maze = tolman_maze::read(MAZE).context("the maze of this program")?;
    let robot = app.robot(system.facts().own_robot)?;
    let (world, schooling) = (("demo".to_owned(), maze.into()), Schooling::default());
    let asked = [(Settings::HELP.to_owned(), String::new())];
    let mut setup = setup_of(&world, robot, &schooling, 1);
    setup.settings.set = &asked;
    let answer = system.learner(&setup).err();
    let all = answer.and_then(|answer| answer.downcast::<AllSettings>().ok());
    Ok(all.map(|all| all.0).unwrap_or_default())
}

fn json_of(app: &App, system: &dyn SystemEntry) -> Result<Value> {
    let facts = system.facts();
    let presets = facts.presets.iter();
    let presets = presets.map(|(name, about)| json!({ "name": name, "about": about }));
    let robots = app.registry().robots_of(system);
    let names: Vec<&str> = robots.iter().map(|robot| robot.name).collect();
    let others = app.registry().robots.iter();
    let refused =
        others.filter_map(|robot| Some((robot.name.to_owned(), system.why_not(robot)?.into())));
    Ok(json!({
        "settings": settings(app, system)?,
        "name": facts.name,
        "title": facts.title,
        "about": facts.about,
        "paper": facts.is_paper,
        "learns": facts.learns,
        "drives": facts.drives == DrivesBy::AnyMap,
        "maps_logs": facts.log_mapper.is_some(),
        "baseline": facts.baseline.is_some(),
        "presets": presets.collect::<Vec<Value>>(),
        "robots": names,
        "why_not": refused.collect::<serde_json::Map<String, Value>>(),
    }))
}
