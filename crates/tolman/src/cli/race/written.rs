//! The moves of a run as builders write them, and read from that.

use anyhow::anyhow;
use tolman_maze::Direction;
use tolman_planners::speed_run::{RunMove, RunState, Side, Slalom, SpeedRunConfig};
use tolman_systems::micromouse::competition::RunLeg;

use super::told::half_cells;
use crate::cli::{OrBadInput, Result};

/// How a run is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Writing {
    Letters,
    Cells,
    Names,
    Places,
    C,
}

/// Values of `--moves`.
pub(super) const WRITINGS: [(&str, &str, Writing); 5] = [
    (
        "letters",
        "The letters of kerikun11/micromouse-maze-library",
        Writing::Letters,
    ),
    (
        "cells",
        "F, L or R for each cell: ahead, to the left, to the right",
        Writing::Cells,
    ),
    (
        "names",
        "Names of turns, such as SD45R and SS90SL, and millimetres",
        Writing::Names,
    ),
    (
        "places",
        "Where each move begins, in half cells to the east and north, and its heading",
        Writing::Places,
    ),
    (
        "c",
        "An array in C, for the header of crates/mouse-c",
        Writing::C,
    ),
];

impl Writing {
    /// Returns a run as it is written.
    pub(super) fn of(self, run: &[RunLeg], config: &SpeedRunConfig) -> String {
        let all = |separator: &str, each: &dyn Fn(&RunLeg) -> String| {
            run.iter()
                .map(each)
                .collect::<Vec<String>>()
                .join(separator)
        };
        match self {
            Self::Letters => all("", &|leg| {
                let (letter, count) = leg.step.letters();
                letter.to_string().repeat(count.into())
            }),
            Self::Cells => cells(run),
            Self::Names => all(", ", &|leg| name(leg, config)),
            Self::Places => all("; ", &|leg| {
                let (x, y, heading) = half_cells(leg.step.from);
                format!("{x} {y} {heading}°")
            }),
            Self::C => format!(
                "\nstatic const tolman_move run[] = {{\n{}\n}};",
                all("\n", &|leg| {
                    let (kind, amount) = c_move(leg.step.run_move);
                    format!("    {{ {kind}, {amount}, {} }},", leg.time_ms)
                })
            ),
        }
    }
}

/// Returns the side by which the run leaves each cell, seen from how it came into it.
fn cells(run: &[RunLeg]) -> String {
    let mut heading = match run.first().map(|leg| leg.step.from) {
        Some(RunState::Straight { heading, .. } | RunState::Edge { heading, .. }) => heading,
        Some(RunState::Diagonal { into, .. }) => into,
        None => Direction::North,
    };
    let sides = run.iter().flat_map(|leg| leg.step.directions());
    sides
        .map(|side| {
            let letter = match side.seen_from(heading) {
                Direction::North => 'F',
                Direction::West => 'L',
                Direction::East => 'R',
                Direction::South => 'B',
            };
            heading = side;
            letter
        })
        .collect()
}

fn name(leg: &RunLeg, config: &SpeedRunConfig) -> String {
    let half = config.cell_mm / 2.0;
    let (slalom, side) = match leg.step.run_move {
        RunMove::Straight { half_cells } => {
            return format!("FWD {:.0} mm", half * f64::from(half_cells));
        }
        RunMove::Diagonal { cells } => {
            return format!(
                "DIA {:.0} mm",
                half * f64::from(cells) * core::f64::consts::SQRT_2
            );
        }
        RunMove::Turn { slalom, side } => (slalom, side),
    };
    let from_diagonal = matches!(leg.step.from, RunState::Diagonal { .. });
    let turn = match (slalom, from_diagonal) {
        (Slalom::F45, false) => "SD45",
        (Slalom::F45, true) => "DS45",
        (Slalom::F90, _) => "SS90F",
        (Slalom::F135, false) => "SD135",
        (Slalom::F135, true) => "DS135",
        (Slalom::F180, _) => "SS180",
        (Slalom::Fv90, _) => "DD90",
        (Slalom::Fs90, _) if config.slalom.fs90.is_none() => "IP90",
        (Slalom::Fs90, _) => "SS90S",
    };
    let side = match side {
        Side::Left => 'L',
        Side::Right => 'R',
    };
    format!("{turn}{side}")
}

/// Returns the move's name in the header of the C library, and its half cells or its side.
fn c_move(run_move: RunMove) -> (&'static str, String) {
    match run_move {
        RunMove::Straight { half_cells } => ("TOLMAN_STRAIGHT", half_cells.to_string()),
        RunMove::Diagonal { cells } => ("TOLMAN_DIAGONAL", cells.to_string()),
        RunMove::Turn { slalom, side } => {
            let kind = match slalom {
                Slalom::F45 => "TOLMAN_F45",
                Slalom::F90 => "TOLMAN_F90",
                Slalom::F135 => "TOLMAN_F135",
                Slalom::F180 => "TOLMAN_F180",
                Slalom::Fv90 => "TOLMAN_FV90",
                Slalom::Fs90 => "TOLMAN_FS90",
            };
            let side = match side {
                Side::Left => "TOLMAN_LEFT",
                Side::Right => "TOLMAN_RIGHT",
            };
            (kind, side.to_owned())
        }
    }
}

/// A way that a builder's mouse drives.
#[derive(Clone, Debug)]
pub(super) enum Route {
    /// Every move, in the letters of the library.
    Moves(Vec<RunMove>),
    /// The cells, each as the side by which the mouse leaves for the next, seen from its heading.
    Cells(Vec<Direction>),
}

impl Route {
    /// Reads a way: one with an `F` has a letter a cell, any other one a letter a move.
    ///
    /// # Errors
    /// Bad input that names the letter.
    pub(super) fn read(text: &str) -> Result<Self> {
        let is_cells = text.contains('F');
        let letters = || text.chars().filter(|c| !c.is_whitespace());
        let allowed = if is_cells { "FLRB" } else { LETTERS };
        if let Some(bad) = letters().find(|c| !allowed.contains(*c)) {
            return Err(anyhow!(
                "--route: `{bad}` is no letter of a route; give F, L, R and B for cells, or the letters of moves in \
                 `tolman race --help`"
            ))
            .or_bad_input();
        }
        if is_cells {
            let side = |letter| match letter {
                'L' => Direction::West,
                'R' => Direction::East,
                'B' => Direction::South,
                _ => Direction::North,
            };
            return Ok(Self::Cells(letters().map(side).collect()));
        }
        let mut moves = Vec::new();
        letters().for_each(|letter| add(&mut moves, letter));
        Ok(Self::Moves(moves))
    }
}

/// Letters of moves.
const LETTERS: &str = "SswzcZCqQadADuUpPLR";

/// Adds the move of a letter. A straight goes on with the straight before it.
fn add(moves: &mut Vec<RunMove>, letter: char) {
    let turn = |slalom, side| RunMove::Turn { slalom, side };
    let one = match letter {
        'S' => RunMove::Straight { half_cells: 2 },
        's' => RunMove::Straight { half_cells: 1 },
        'w' => RunMove::Diagonal { cells: 1 },
        'z' | 'Z' => turn(Slalom::F45, Side::Left),
        'c' | 'C' => turn(Slalom::F45, Side::Right),
        'q' => turn(Slalom::F90, Side::Left),
        'Q' => turn(Slalom::F90, Side::Right),
        'a' | 'A' => turn(Slalom::F135, Side::Left),
        'd' | 'D' => turn(Slalom::F135, Side::Right),
        'u' => turn(Slalom::F180, Side::Left),
        'U' => turn(Slalom::F180, Side::Right),
        'p' => turn(Slalom::Fv90, Side::Left),
        'P' => turn(Slalom::Fv90, Side::Right),
        'L' => turn(Slalom::Fs90, Side::Left),
        'R' => turn(Slalom::Fs90, Side::Right),
        _ => return,
    };
    match (moves.last_mut(), one) {
        (Some(RunMove::Straight { half_cells }), RunMove::Straight { half_cells: more }) => {
            *half_cells = half_cells.saturating_add(more);
        }
        (Some(RunMove::Diagonal { cells }), RunMove::Diagonal { cells: more }) => {
            *cells = cells.saturating_add(more);
        }
        _ => moves.push(one),
    }
}
