//! Runs a mouse that is a separate program.

use core::time::Duration;

use serde::Serialize;
use tolman_maze::Maze;

use super::{Exchange, Score, Simulator};
use crate::foreign::{Budget, ForeignProgram, Launch, LaunchError, Left, Overrun};

/// Limits at which a mouse is stopped.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Maximum duration of the mouse's run.
    pub time: Duration,
    /// Maximum number of moves, turns and crashes.
    pub movements: u64,
    /// Number of movements after which the reset button is pressed, or `None` for never.
    pub reset_after: Option<u64>,
}

/// Result of a mouse.
#[derive(Clone, Debug, Serialize)]
pub struct Hosted {
    /// Whether the mouse finished a run.
    pub solved: bool,
    /// Score as the code of mms computes it; 2000 if unsolved.
    pub score: f32,
    /// Score as the README of mms defines it; 2000 if unsolved.
    pub score_in_cells: f32,
    /// Way in which the mouse ended.
    pub ended: MouseExit,
    /// Number of moves and turns.
    pub movements: u64,
    /// Number of collisions with walls.
    pub crashes: u64,
    /// Number of lines that were not commands.
    pub invalid_commands: u64,
    /// All figures in half-steps.
    pub half_steps: Score,
    /// All figures in cells.
    pub cells: Score,
}

/// End of a mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum MouseExit {
    /// The mouse ended by itself and reported success.
    Done,
    /// The mouse ended by itself and reported a failure.
    Failed,
    /// The mouse was out of time.
    OutOfTime,
    /// The mouse had made all its movements.
    OutOfMovements,
    /// The mouse wrote a line longer than any command.
    LineTooLong,
    /// The mouse wrote more than any mouse needs to.
    TooMuchOutput,
    /// The mouse closed its stdout and ran on.
    ClosedOutput,
    /// The caller interrupted the game.
    Interrupted,
}

/// Time within which a mouse that has closed its stdout must end. On a busy machine even one that
/// ends at once may need a second.
const GRACE: Duration = Duration::from_secs(5);

/// Runs a program as a mouse in a maze, until it ends or a limit is reached, and returns the
/// result. Then the program is killed, with all processes that it started. Calls `watch` with every
/// line and its answer.
///
/// # Errors
/// [`LaunchError`] if it does not start. A program that fails, or does not solve the maze, is a
/// result.
pub fn host(
    mouse: &Launch<'_>,
    maze: &Maze,
    limits: &Limits,
    watch: impl FnMut(&Exchange),
) -> Result<Hosted, LaunchError> {
    let budget = Budget {
        time: limits.time,
        ..Budget::default()
    };
    let mut program = ForeignProgram::start(mouse, budget)?;
    let mut simulator = Simulator::new(maze);
    if let Some(movements) = limits.reset_after {
        simulator.reset_after(movements);
    }
    let ended = match converse(&mut simulator, &mut program, limits, watch) {
        Err(Overrun::Time) => MouseExit::OutOfTime,
        Err(Overrun::Bytes | Overrun::Lines) => MouseExit::TooMuchOutput,
        Err(Overrun::LineBytes) => MouseExit::LineTooLong,
        Err(Overrun::Stop) => MouseExit::Interrupted,
        Ok(Said::AllItMay) => MouseExit::OutOfMovements,
        Ok(Said::AllItWould) => match program.left(limits.time.min(GRACE))? {
            Left::ByItself(status) if status.success() => MouseExit::Done,
            Left::ByItself(_) => MouseExit::Failed,
            Left::Killed => MouseExit::ClosedOutput,
        },
    };
    let (half_steps, cells) = (simulator.score_in_half_steps(), simulator.score_in_cells());
    Ok(Hosted {
        solved: half_steps.solved,
        score: half_steps.value(),
        score_in_cells: cells.value(),
        ended,
        movements: simulator.movements(),
        crashes: simulator.crashes(),
        invalid_commands: simulator.invalid(),
        half_steps: *half_steps,
        cells: *cells,
    })
}

/// Reason why a conversation is over.
enum Said {
    /// The mouse closed its stdout.
    AllItWould,
    /// The mouse has made all its allowed movements.
    AllItMay,
}

fn converse(
    simulator: &mut Simulator<'_>,
    mouse: &mut ForeignProgram,
    limits: &Limits,
    mut watch: impl FnMut(&Exchange),
) -> Result<Said, Overrun> {
    while let Some(line) = mouse.hear()? {
        let exchange = Exchange::of(simulator, &line);
        watch(&exchange);
        if simulator.movements() + simulator.crashes() >= limits.movements {
            return Ok(Said::AllItMay);
        }
        if let Some(reply) = exchange.reply {
            mouse.say(reply)?;
        }
    }
    Ok(Said::AllItWould)
}
