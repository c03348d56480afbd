//! A race in a maze with unknown walls: what is known, and where to look next.

use std::io::Write;
use std::path::Path;

use anyhow::Context;
use serde_json::json;
use tolman_arena::competition::{self, HalfKnown};
use tolman_maze::{Cell, Direction, MazeFile};
use tolman_planners::speed_run::{Decision, SpeedRunConfig};

use super::written::Writing;
use crate::cli::looks::Looks;
use crate::cli::words::counted;
use crate::cli::{OrBadInput, Result, maze};

/// Tells the best run through the known walls of a maze, and what a mouse at its start does next.
pub(super) fn tell(
    path: &Path,
    file: &MazeFile,
    config: &SpeedRunConfig,
    (looks, writing): (&Looks, Writing),
    out: &mut dyn Write,
) -> Result {
    let start = file
        .maze
        .start()
        .unwrap_or((Cell::new(0, 0), Direction::North));
    let plan = competition::half_known(file, start, file.maze.goals(), config);
    let name = maze::name(path);
    let HalfKnown {
        known,
        possible_ms,
        next,
    } = plan.with_context(|| name.clone()).or_bad_input()?;
    let whole = |ms: u32| config.start_ms() + ms + config.stop_ms();
    let known_ms = (!known.is_empty()).then(|| whole(known.iter().map(|leg| leg.time_ms).sum()));
    let possible_ms = possible_ms.map(whole);
    let side = match next {
        Decision::Drive(side) => Some(side.to_string()),
        _ => None,
    };
    let run = writing.of(&known, config);
    if looks.json {
        let line = json!({
            "maze": name,
            "mouse": config,
            "unknown_walls": file.unknown.len(),
            "known_ms": known_ms,
            "known_path": run,
            "possible_ms": possible_ms,
            "next": side,
        });
        return Ok(writeln!(out, "{line}")?);
    }
    let seconds = |ms: u32| format!("{:.3} s", f64::from(ms) / 1000.0);
    let told = match (known_ms, possible_ms) {
        (_, None) => "no way to a goal is left, whatever the unknown walls are".to_owned(),
        (None, Some(possible)) => format!(
            "no run is known; the best possible takes {}",
            seconds(possible)
        ),
        (Some(known), Some(possible)) if known == possible => {
            format!(
                "the known run of {} is the best, whatever the unknown walls are: {run}",
                seconds(known)
            )
        }
        (Some(known), Some(possible)) => format!(
            "the best known run takes {}, the best possible {}: {run}",
            seconds(known),
            seconds(possible)
        ),
    };
    let next = side.map_or_else(String::new, |side| {
        format!("; next, drive {side} from {}", start.0)
    });
    Ok(writeln!(
        out,
        "{name}: {}: {told}{next}",
        counted(file.unknown.len(), "unknown wall")
    )?)
}
