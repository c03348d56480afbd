//! A race in a maze with unknown walls: what is known, and where to look next.

use std::io::Write;
use std::path::Path;

use anyhow::Context;
use serde_json::json;
use tolman_arena::competition::{self, HalfKnown};
use tolman_maze::MazeFile;
use tolman_planners::speed_run::{Decision, SpeedRunConfig};

use super::written::Writing;
use crate::cli::half_known::{Plan, Whereabouts};
use crate::cli::looks::Looks;
use crate::cli::{OrBadInput, Result, maze};

/// Tells the best run through the known walls of a maze, and what a mouse does next.
pub(super) fn tell(
    path: &Path,
    (file, whereabouts): (&MazeFile, &Whereabouts),
    config: &SpeedRunConfig,
    (looks, writing): (&Looks, Writing),
    out: &mut dyn Write,
) -> Result {
    let [start, at] = whereabouts.in_maze(&file.maze);
    let plan = competition::half_known(file, start, at, file.maze.goals(), config);
    let HalfKnown {
        known,
        possible_ms,
        next,
    } = plan.with_context(|| maze::name(path)).or_bad_input()?;
    let whole = |ms: u32| config.start_ms() + ms + config.stop_ms();
    let known_ms: u32 = known.iter().map(|leg| leg.time_ms).sum();
    let side = match next {
        Decision::Drive(side) => Some(side),
        _ => None,
    };
    let plan = Plan {
        known: (!known.is_empty()).then(|| whole(known_ms)),
        possible: possible_ms.map(whole),
        run: writing.of(&known, config),
        next: side.map(|side| (format!("drive {side}"), at.0)),
    };
    if looks.json {
        let line = json!({
            "maze": maze::name(path),
            "mouse": config,
            "unknown_walls": file.unknown.len(),
            "known_ms": plan.known,
            "known_path": plan.run,
            "possible_ms": plan.possible,
            "next": side.filter(|_| plan.is_open()).map(|side| side.to_string()),
        });
        return Ok(writeln!(out, "{line}")?);
    }
    let seconds = |ms: u32| format!("{:.3} s", f64::from(ms) / 1000.0);
    Ok(writeln!(out, "{}", plan.told(path, file, seconds))?)
}
