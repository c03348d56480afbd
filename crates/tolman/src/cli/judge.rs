//! `tolman judge`: the map that a system learned on a robot, by where the robot truly was.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_arena::contest::WatchedRun;

use super::{App, Failure, OrBadInput, Result, file, maze};

/// Judges the map that a system learned with `tolman brain`, by where its robot truly was; exits 1
/// if it is wrong or unfinished
#[derive(clap::Args)]
#[command(after_help = "The run is a file of JSON; `docs/brain.md` describes it.")]
pub(super) struct Arguments {
    /// Run with the robot's true path and the system's answers
    #[arg(value_name = "FILE")]
    run: PathBuf,
    /// System that learned the map
    #[arg(long, value_name = "NAME")]
    system: String,
    /// Maze of the run
    #[arg(long, value_name = "FILE")]
    maze: PathBuf,
    /// Write the judgement as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let system = app.system(&arguments.system, |_| true)?;
    let maze = maze::read(&arguments.maze)?.maze;
    let path = &arguments.run;
    let name = || path.display().to_string();
    let text = file::read(path, "give a run with the robot's true path")?;
    let run: WatchedRun = serde_json::from_str(&text)
        .with_context(name)
        .or_bad_input()?;
    let judged = run.judge(&maze, system.facts().places);
    let judged = judged.with_context(name).or_bad_input()?;
    let complaint = judged.complaint();
    if arguments.json {
        let told = json!({
            "right": judged.is_right,
            "right_of_visited": judged.is_right_of_visited,
            "complaint": complaint,
            "places": judged.places,
            "purity": judged.purity,
            "link_precision": judged.link_precision,
            "link_recall": judged.link_recall,
        });
        writeln!(out, "{told}")?;
    }
    match complaint {
        None if arguments.json => Ok(()),
        None => Ok(writeln!(out, "the map is right")?),
        Some(complaint) => Err(Failure::Failed(anyhow!(
            "the map is wrong or unfinished: {complaint}"
        ))),
    }
}
