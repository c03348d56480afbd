//! Describes a race in words, letters and JSON.

use std::path::Path;

use anyhow::Error;
use serde_json::{Value, json};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{RunMove, RunState, Side};
use tolman_systems::micromouse::competition::{RunLeg, SpeedRunExploration};

use super::shown::side_towards;
use super::written::Writing;
use super::{Heat, Raced};
use crate::cli::mice::{MouseResult, ON_GOAL};

impl MouseResult for Heat {
    fn has_solved(&self) -> bool {
        self.0.iter().all(Raced::is_proven)
    }

    fn outcome(&self) -> String {
        match self.0.as_slice() {
            [alone] => alone.outcome(),
            mice => table(mice),
        }
    }

    fn json(&self) -> Result<Vec<Value>, Error> {
        Ok(self.0.iter().map(Raced::json).collect())
    }

    fn summary(heats: &[(&Path, Self)]) -> String {
        let mice = heats.first().map_or(0, |(_, heat)| heat.0.len());
        let of_mouse = |number: usize| heats.iter().filter_map(move |(_, heat)| heat.0.get(number));
        let lines: Vec<String> = (0..mice)
            .map(|number| Raced::summary(&of_mouse(number).collect::<Vec<_>>()))
            .collect();
        lines.join("\n")
    }
}

/// Returns a table with a line for each mouse, the fastest first.
fn table(mice: &[Raced]) -> String {
    let head = [
        "mouse", "run, s", "cells", "search", "proof", "home", "moves",
    ]
    .map(str::to_owned);
    let mut order: Vec<&Raced> = mice.iter().collect();
    order.sort_by_key(|raced| {
        let explored = raced.explored.as_ref();
        explored.map_or(u32::MAX, |explored| raced.run_ms(explored))
    });
    let lines = order.into_iter().map(|raced| {
        let driver = raced.driver.clone().unwrap_or_default();
        let Some(explored) = &raced.explored else {
            return [driver, "no way".to_owned()]
                .into_iter()
                .chain(vec![String::new(); 5])
                .collect();
        };
        let run = f64::from(raced.run_ms(explored)) / 1000.0;
        let not = if raced.is_proven() {
            ""
        } else {
            " (not proven)"
        };
        let cells = [
            explored.cells,
            explored.search_cells,
            explored.proof_cells,
            home(explored),
        ];
        [driver, format!("{run:.3}{not}")]
            .into_iter()
            .chain(cells.map(|cells| cells.to_string()))
            .chain([raced.writing.of(&explored.run, &raced.config)])
            .collect()
    });
    let lines: Vec<Vec<String>> = [head.to_vec()].into_iter().chain(lines).collect();
    let width = |column: usize| {
        let cells = lines.iter().filter_map(|line| line.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let line = |line: &Vec<String>| {
        let cells = line.iter().zip(&widths).enumerate();
        let cells = cells.map(|(column, (cell, width))| match column {
            0 => format!("{cell:width$}"),
            6 => cell.clone(),
            _ => format!("{cell:>width$}"),
        });
        let line = cells.collect::<Vec<_>>().join("  ");
        format!("\n  {}", line.trim_end())
    };
    lines.iter().map(line).collect()
}

impl Raced {
    fn is_proven(&self) -> bool {
        let explored = self.explored.as_ref();
        explored.is_some_and(|explored| explored.verdict.is_ok())
    }

    fn json(&self) -> Value {
        let mut line = json!({
            "mouse": self.config,
            "mouse_file": self.driver,
            "proven": self.is_proven(),
            "search_path": self.search_path,
        });
        if let Some(explored) = &self.explored {
            line["cells"] = json!({
                "all": explored.cells,
                "search": explored.search_cells,
                "proof": explored.proof_cells,
                "home": home(explored),
            });
            line["run_ms"] = json!(self.run_ms(explored));
            line["start_ms"] = json!(self.config.start_ms());
            line["stop_ms"] = json!(self.config.stop_ms());
            line["search_ms"] = json!(self.search_ms());
            line["run_path"] = json!(Writing::Letters.of(&explored.run, &self.config));
            line["moves"] = explored.run.iter().map(move_json).collect();
        }
        line
    }

    /// Returns the results of a mouse in several mazes in one line.
    fn summary(raced: &[&Self]) -> String {
        let explored: Vec<(&Self, &SpeedRunExploration)> = raced
            .iter()
            .filter_map(|raced| Some((*raced, raced.explored.as_ref()?)))
            .collect();
        let mean = |value: fn(&Self, &SpeedRunExploration) -> u32| {
            let sum: f64 = explored
                .iter()
                .map(|(raced, explored)| f64::from(value(raced, explored)))
                .sum();
            sum / explored.len().max(1) as f64
        };
        let proven = raced.iter().filter(|raced| raced.is_proven()).count();
        let driver = raced.first().and_then(|raced| raced.driver.as_ref());
        format!(
            "{}{} mazes: {proven} proven; mean run {:.3} s, {:.1} cells explored: search {:.1}, proof {:.1}, home {:.1}",
            driver.map_or_else(String::new, |driver| format!("{driver}: ")),
            raced.len(),
            mean(Self::run_ms) / 1000.0,
            mean(|_, explored| explored.cells),
            mean(|_, explored| explored.search_cells),
            mean(|_, explored| explored.proof_cells),
            mean(|_, explored| home(explored)),
        )
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
            "run of {:.3} s, {proven}: {}; {cells} cells explored{}: search {search_cells}, proof {proof_cells}, home {}",
            f64::from(self.run_ms(explored)) / 1000.0,
            self.writing.of(&explored.run, &self.config),
            match self.search_ms() {
                Some(ms) => format!(" in {:.1} s", ms as f64 / 1000.0),
                None => String::new(),
            },
            home(explored),
        )
    }

    /// Returns the duration of the run from rest to rest, ms.
    fn run_ms(&self, explored: &SpeedRunExploration) -> u32 {
        match explored.run.is_empty() {
            true => 0,
            false => self.config.start_ms() + explored.certificate.time_ms + self.config.stop_ms(),
        }
    }

    /// Returns the duration of the exploration, ms, if the mouse's file says how fast it searches.
    fn search_ms(&self) -> Option<u64> {
        let pace = self.config.search?;
        let of = |letter| match letter {
            'S' => pace.ahead_ms,
            'T' => pace.back_ms,
            _ => pace.turn_ms,
        };
        Some(
            self.search_path
                .chars()
                .map(|letter| u64::from(of(letter)))
                .sum(),
        )
    }
}

/// Returns the number of cells driven back to the start after the run was proven.
fn home(explored: &SpeedRunExploration) -> u32 {
    let before = explored.search_cells + explored.proof_cells;
    explored.cells.saturating_sub(before)
}

fn move_json(leg: &RunLeg) -> Value {
    let (half_x, half_y, heading_deg) = half_cells(leg.step.from);
    let mut line = json!({
        "move": name(leg.step.run_move),
        "from": { "half_x": half_x, "half_y": half_y, "heading_deg": heading_deg },
        "time_ms": leg.time_ms,
    });
    match leg.step.run_move {
        RunMove::Straight { half_cells } => line["half_cells"] = json!(half_cells),
        RunMove::Diagonal { cells } => line["cells"] = json!(cells),
        RunMove::Turn { side, .. } => line["side"] = json!(side_name(side)),
    }
    line
}

/// Returns the place of a state in half cells from the maze's south-west corner to the east and
/// north, and its heading in degrees, counter-clockwise from east. Middles of cells have two odd
/// coordinates, middles of sides one.
pub(super) fn half_cells(state: RunState) -> (i32, i32, i32) {
    let on_side = |cell: Cell, into: Direction| {
        let (east, north) = into.step();
        let half = |at: u16, step: i8| 2 * i32::from(at) + 1 - i32::from(step);
        (half(cell.x, east), half(cell.y, north))
    };
    let ((x, y), heading_deg) = match state {
        RunState::Straight { cell, heading } => (
            (2 * i32::from(cell.x) + 1, 2 * i32::from(cell.y) + 1),
            degrees(heading),
        ),
        RunState::Edge { cell, heading } => (on_side(cell, heading), degrees(heading)),
        RunState::Diagonal { cell, into, out } => {
            let half = if out == into.left() { 45 } else { -45 };
            (on_side(cell, into), degrees(into) + half)
        }
    };
    (x, y, heading_deg)
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
        RunMove::Turn { slalom, .. } => slalom.name(),
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
        RunMove::Straight { half_cells } => (f64::from(half_cells) / 2.0).to_string(),
        RunMove::Diagonal { cells } => cells.to_string(),
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
