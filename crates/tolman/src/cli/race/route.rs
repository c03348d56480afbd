//! `tolman race --route`: a builder's own way, timed and checked.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_arena::competition;
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{RunMove, SpeedRunCertificate, SpeedRunConfig};
use tolman_systems::micromouse::competition::RunLeg;

use super::written::{Route, Writing};
use crate::cli::looks::Looks;
use crate::cli::{Failure, OrBadInput, Result, maze};

/// Times a way through a maze, and tells how long the best run takes.
///
/// # Errors
/// If the way cannot be driven, or does not end at a goal.
pub(super) fn tell(
    path: &Path,
    maze: &Maze,
    config: &SpeedRunConfig,
    route: &Route,
    (looks, writing): (&Looks, Writing),
    out: &mut dyn Write,
) -> Result {
    let name = maze::name(path);
    let (start, heading) = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
    let (heading, moves): (Direction, Vec<RunMove>) = match route {
        Route::Moves(moves) => (heading, moves.clone()),
        Route::Cells(sides) => {
            let (heading, run) = along(maze, (start, heading), sides, config)?;
            (heading, run.iter().map(|leg| leg.step.run_move).collect())
        }
    };
    let mine = SpeedRunCertificate {
        start,
        heading,
        moves,
        time_ms: 0,
    };
    let driven = mine.driven_ms(maze, config, maze.goals());
    let moves_ms = driven.with_context(|| format!("{name}: the route cannot be driven"));
    let moves_ms = moves_ms.map_err(Failure::Failed)?;
    let best = competition::half_known(
        maze,
        (start, heading),
        (start, heading),
        maze.goals(),
        config,
    );
    let best = best.with_context(|| name.clone()).or_bad_input()?;
    let whole = |ms: u32| config.start_ms() + ms + config.stop_ms();
    let (route_ms, best_ms) = (whole(moves_ms), best.possible_ms.map_or(0, whole));
    let run = writing.of(&best.known, config);
    if looks.json {
        let line = json!({
            "maze": name, "mouse": config, "route_ms": route_ms, "run_ms": best_ms, "run_path": run,
        });
        return Ok(writeln!(out, "{line}")?);
    }
    let seconds = |ms: u32| f64::from(ms) / 1000.0;
    Ok(writeln!(
        out,
        "{name}: the route takes {:.3} s; the best run takes {:.3} s, {:.3} s less: {run}",
        seconds(route_ms),
        seconds(best_ms),
        seconds(route_ms - best_ms.min(route_ms)),
    )?)
}

/// Returns the fastest run along cells, and the heading in which it begins.
fn along(
    maze: &Maze,
    (start, mut heading): (Cell, Direction),
    sides: &[Direction],
    config: &SpeedRunConfig,
) -> Result<(Direction, Vec<RunLeg>)> {
    let mut lane = Maze::solid(maze.grid());
    let mut at = start;
    let first = sides.first().map_or(heading, |side| heading.turned(*side));
    for (number, side) in sides.iter().enumerate() {
        heading = heading.turned(*side);
        let Some(next) = maze.beside(at, heading) else {
            return Err(Failure::Failed(anyhow!(
                "cell {} of the route, {at}, has a wall to the {heading}",
                number + 1
            )));
        };
        lane.set_wall(at, heading, false);
        at = next;
    }
    if !maze.goals().contains(&at) {
        return Err(Failure::Failed(anyhow!(
            "the route ends in {at}, which is not a goal"
        )));
    }
    let plan = competition::half_known(&lane, (start, first), (start, first), &[at], config);
    let run = plan.or_bad_input()?.known;
    match run.is_empty() && !sides.is_empty() {
        true => Err(Failure::Failed(anyhow!(
            "no run of this mouse follows the route: it lacks a turn, such as fs90 or in_place_ms"
        ))),
        false => Ok((first, run)),
    }
}
