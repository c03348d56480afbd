//! A mouse in a maze with unknown walls: what is known, and where to stop next.

use std::io::Write;
use std::path::Path;

use anyhow::Context;
use serde_json::json;
use tolman_maze::MazeFile;
use tolman_planners::moves::{MouseStep, MoveDecision, MoveExplorer, MoveExplorerConfig, MoveMap};
use tolman_planners::{Passages, Unknown};
use tolman_systems::micromouse::{Movement, Order, SIDE};

use super::in_words;
use crate::cli::half_known::{Plan, Whereabouts};
use crate::cli::looks::Looks;
use crate::cli::words::counted;
use crate::cli::{OrBadInput, Result, maze};

/// Tells the run of fewest steps through the known walls of a maze, and what a mouse without
/// rollouts does next.
pub(super) fn tell(
    path: &Path,
    (file, whereabouts): (&MazeFile, &Whereabouts),
    looks: &Looks,
    out: &mut dyn Write,
) -> Result {
    let [(start, heading), (at, mut facing)] = whereabouts.in_maze(&file.maze);
    let goals = file.maze.goals();
    let named = || maze::name(path);
    let passages = |unknown| {
        let passages = Passages::<SIDE>::new(file, unknown);
        passages.with_context(named).or_bad_input()
    };
    let map = |passages: &_| MoveMap::new(passages, goals.iter().copied());
    let known = passages(Unknown::Closed)?;
    let known_map = map(&known);
    let (mut side, mut run) = (heading, Vec::new());
    for leap in known_map.way(&known, start) {
        run.push(Order::from(MouseStep::of_leap(&mut side, leap)));
    }
    let explorer = MoveExplorer::<SIDE>::new(MoveExplorerConfig::tuned(), start);
    let decision = explorer.or_bad_input()?.decide(file, goals, at);
    let next = match decision.with_context(named).or_bad_input()? {
        MoveDecision::Drive(leap) => Some(Order::from(MouseStep::of_leap(&mut facing, leap))),
        MoveDecision::Turn => Some(Order::new(90, 0)),
        _ => None,
    };
    let told: Vec<String> = run.iter().map(|order| in_words(*order)).collect();
    let plan = Plan {
        known: known_map.moves(start).map(u32::from),
        possible: map(&passages(Unknown::Open)?).moves(start).map(u32::from),
        run: told.join("; "),
        next: next.map(|order| {
            let verb = match order.movement {
                Movement::Cells(0) => "turn",
                _ => "go",
            };
            (format!("{verb} {}", in_words(order)), at)
        }),
    };
    if looks.json {
        let line = json!({
            "maze": maze::name(path),
            "unknown_walls": file.unknown.len(),
            "known_steps": plan.known,
            "known_run": run,
            "possible_steps": plan.possible,
            "next": next.filter(|_| plan.is_open()),
        });
        return Ok(writeln!(out, "{line}")?);
    }
    let steps = |count: u32| counted(count as usize, "step");
    Ok(writeln!(out, "{}", plan.told(path, file, steps))?)
}
