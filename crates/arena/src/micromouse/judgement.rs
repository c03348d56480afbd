//! Compares a trial with the best possible one.

use serde::Serialize;
use tolman_maze::Maze;
use tolman_planners::moves::MoveMap;
use tolman_planners::{Passages, TooLarge, Unknown};
use tolman_systems::micromouse::{Driver, MouseError, SIDE, Search, Searcher};

use super::{MouseTrial, RefereedStep, ScoreSheet, brief, check};
use crate::BoxError;
use crate::run::TaskEnd;

/// Quality of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// Number of steps of the first run, the reset included, or `None` if it did not end.
    pub run_1: Option<u32>,
    /// Number of steps of the second run, or `None` if it did not end.
    pub run_2: Option<u32>,
    /// A thirtieth of the steps of the first run plus those of the second; `None` if the mouse did
    /// not finish.
    pub score: Option<f64>,
    /// Minimum number of steps from the start to a goal.
    pub optimum: u32,
    /// Score of a mouse that knows the maze: to the goal, a reset, and to the goal again.
    pub floor: f64,
    /// Whether the mouse proved that its second run is the best, and the independent checker
    /// agrees.
    pub certified: bool,
}

impl Judgement {
    /// Judges a trial that `mouse` has played in `maze`.
    ///
    /// # Errors
    /// If the maze has more than [`SIDE`] columns or rows.
    pub fn of(
        maze: &Maze,
        mouse: &Driver<impl Search>,
        trial: &MouseTrial,
    ) -> Result<Self, TooLarge> {
        let passages = Passages::<SIDE>::new(maze, Unknown::Closed)?;
        let map = MoveMap::new(&passages, maze.goals().iter().copied());
        let optimum = maze.start().and_then(|(start, _)| map.moves(start));
        let optimum = optimum.map_or(0, u32::from);
        let verdict = trial.verdict;
        let certified = mouse.certificate().is_some_and(|certificate| {
            Some(certificate.closed_cost) == verdict.run_2 && check(certificate, maze).is_ok()
        });
        Ok(Self {
            run_1: verdict.run_1,
            run_2: verdict.run_2,
            score: verdict.score(),
            optimum,
            floor: floor(optimum),
            certified,
        })
    }

    /// Returns the difference of the score from the floor, or `None` if the mouse did not finish.
    #[must_use]
    pub fn above_floor(&self) -> Option<f64> {
        Some(self.score? - self.floor)
    }
}

/// Returns the score of a mouse that knows its maze. Its best run takes `optimum` steps. The mouse
/// runs to the goal, is reset, and runs to the goal again.
#[must_use]
pub fn floor(optimum: u32) -> f64 {
    f64::from(optimum) + f64::from(optimum + 1) / 30.0
}

/// Sends a mouse with a search through `maze` and judges it. `seed` seeds what the search draws.
/// Calls `see` with every step as soon as it is made. From a start that is a goal, the best runs
/// have no steps, and nothing is to be explored.
///
/// # Errors
/// If no mouse can run in the maze.
pub fn try_on(
    maze: &Maze,
    searcher: Searcher,
    seed: u64,
    see: impl FnMut(&RefereedStep),
) -> Result<(MouseTrial, Judgement), BoxError> {
    let brief = brief(maze)?;
    if !brief.goals.contains(&brief.start) {
        return send(maze, searcher.mouse(&brief, seed)?, see);
    }
    let verdict = ScoreSheet {
        run_1: Some(0),
        run_2: Some(0),
    };
    let trial = MouseTrial {
        steps: Vec::new(),
        verdict,
        end: TaskEnd::Done,
    };
    let judgement = Judgement {
        run_1: verdict.run_1,
        run_2: verdict.run_2,
        score: verdict.score(),
        optimum: 0,
        floor: 0.0,
        certified: true,
    };
    Ok((trial, judgement))
}

/// Sends a mouse through `maze` and judges it. Calls `see` with every step as soon as it is made.
///
/// # Errors
/// If the mouse cannot run in the maze.
pub fn send(
    maze: &Maze,
    mut mouse: Driver<impl Search>,
    mut see: impl FnMut(&RefereedStep),
) -> Result<(MouseTrial, Judgement), BoxError> {
    let trial = MouseTrial::play(maze, &mut mouse, |step, _| see(step))?;
    let judgement = Judgement::of(maze, &mouse, &trial).map_err(MouseError::from)?;
    Ok((trial, judgement))
}
