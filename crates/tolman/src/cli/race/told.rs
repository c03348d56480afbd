//! Describes a race in words, letters and JSON.

use std::path::Path;

use anyhow::Error;
use serde_json::{Value, json};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{RunMove, RunState, Side, Slalom};
use tolman_systems::micromouse::competition::{RunLeg, SpeedRunExploration};

use super::Raced;
use super::shown::side_towards;
use crate::cli::mice::{MouseResult, ON_GOAL};

impl MouseResult for Raced {
    fn has_solved(&self) -> bool {
        let explored = self.explored.as_ref();
        explored.is_some_and(|explored| explored.verdict.is_ok())
    }

    fn outcome(&self) -> String {
        let Some(explored) = &self.explored else {
            return "no way that the mouse can drive leads to a goal".to_owned();
        };
        let proven = match &explored.verdict {
            Ok(()) => "proven".to_owned(),
            Err(error) => format!("not proven: {error}"),
        };
        let SpeedRunExploration {
            cells,
            search_cells,
            proof_cells,
            ..
        } = explored;
        if explored.run.is_empty() {
            return format!("{ON_GOAL}: 0.000 s, {proven}");
        }
        format!(
            "run of {:.3} s, {proven}: {}; {cells} cells explored: search {search_cells}, proof {proof_cells}, home {}",
            f64::from(explored.certificate.time_ms) / 1000.0,
            letters(&explored.run),
            home(explored),
        )
    }

    fn json(&self) -> Result<Value, Error> {
        let mut line = json!({
            "mouse": self.config,
            "proven": self.has_solved(),
            "search_path": self.search_path,
        });
        if let Some(explored) = &self.explored {
            line["cells"] = json!({
                "all": explored.cells,
                "search": explored.search_cells,
                "proof": explored.proof_cells,
                "home": home(explored),
            });
            line["run_ms"] = json!(explored.certificate.time_ms);
            line["run_path"] = json!(letters(&explored.run));
            line["moves"] = explored.run.iter().map(move_json).collect();
        }
        Ok(line)
    }

    fn summary(raced: &[(&Path, Self)]) -> String {
        let explored: Vec<&SpeedRunExploration> = raced
            .iter()
            .filter_map(|(_, raced)| raced.explored.as_ref())
            .collect();
        let mean = |value: fn(&SpeedRunExploration) -> u32| {
            let sum: f64 = explored
                .iter()
                .map(|explored| f64::from(value(explored)))
                .sum();
            sum / explored.len().max(1) as f64
        };
        let proven = raced.iter().filter(|(_, raced)| raced.has_solved()).count();
        format!(
            "{} mazes: {proven} proven; mean run {:.3} s, {:.1} cells explored: search {:.1}, proof {:.1}, home {:.1}",
            raced.len(),
            mean(|explored| explored.certificate.time_ms) / 1000.0,
            mean(|explored| explored.cells),
            mean(|explored| explored.search_cells),
            mean(|explored| explored.proof_cells),
            mean(home),
        )
    }
}

/// Returns the number of cells driven back to the start after the run was proven.
fn home(explored: &SpeedRunExploration) -> u32 {
    let before = explored.search_cells + explored.proof_cells;
    explored.cells.saturating_sub(before)
}

/// Returns the run in letters.
fn letters(run: &[RunLeg]) -> String {
    let letters = run.iter().map(|leg| leg.step.letters());
    letters
        .flat_map(|(letter, count)| core::iter::repeat_n(letter, count.into()))
        .collect()
}

fn move_json(leg: &RunLeg) -> Value {
    let (cell, heading_deg) = match leg.step.from {
        RunState::Straight { cell, heading } => (cell, degrees(heading)),
        RunState::Diagonal { cell, into, out } => {
            let half = if out == into.left() { 45 } else { -45 };
            (cell, degrees(into) + half)
        }
    };
    let mut line = json!({
        "move": name(leg.step.run_move),
        "from": { "x": cell.x, "y": cell.y, "heading_deg": heading_deg },
        "time_ms": leg.time_ms,
    });
    match leg.step.run_move {
        RunMove::Straight { cells } | RunMove::Diagonal { cells } => line["cells"] = json!(cells),
        RunMove::Turn { side, .. } => line["side"] = json!(side_name(side)),
    }
    line
}

/// Returns the heading in degrees, counter-clockwise from east.
const fn degrees(heading: Direction) -> i32 {
    match heading {
        Direction::North => 90,
        Direction::East => 0,
        Direction::South => -90,
        Direction::West => 180,
    }
}

const fn name(run_move: RunMove) -> &'static str {
    match run_move {
        RunMove::Straight { .. } => "straight",
        RunMove::Diagonal { .. } => "diagonal",
        RunMove::Turn { slalom, .. } => match slalom {
            Slalom::F45 => "F45",
            Slalom::F90 => "F90",
            Slalom::F135 => "F135",
            Slalom::F180 => "F180",
            Slalom::Fv90 => "FV90",
        },
    }
}

const fn side_name(side: Side) -> &'static str {
    match side {
        Side::Left => "left",
        Side::Right => "right",
    }
}

/// Returns a move in words.
pub(super) fn in_words(leg: &RunLeg) -> String {
    let how = match leg.step.run_move {
        RunMove::Straight { cells } | RunMove::Diagonal { cells } => cells.to_string(),
        RunMove::Turn { side, .. } => side_name(side).to_owned(),
    };
    format!("{} {how}, {} ms", name(leg.step.run_move), leg.time_ms)
}

/// Returns the cells of an exploration as letters. The first letter gives the turn at the start.
pub(super) fn search_path(maze: &Maze, cells: &[Cell]) -> String {
    let mut heading = maze
        .start()
        .map_or(Direction::North, |(_, heading)| heading);
    let step = |pair: &[Cell]| {
        let side = side_towards(pair[0], pair[1])?;
        let letter = match side.seen_from(heading) {
            Direction::North => 'S',
            Direction::West => 'L',
            Direction::East => 'R',
            Direction::South => 'T',
        };
        heading = side;
        Some(letter)
    };
    cells.windows(2).filter_map(step).collect()
}
