//! Both runs of one mouse in one maze.

use tolman_maze::{Cell, Maze};
use tolman_systems::micromouse::{Driver, MouseError, Order, OrderError, Search};

use super::{Referee, RefereeError, Ruling, ScoreSheet};

/// What became of one mouse in one maze.
#[derive(Clone, Debug, PartialEq)]
pub struct MouseTrial {
    /// Every order that counted, in order.
    pub steps: Vec<RefereedStep>,
    /// What the referee wrote down.
    pub verdict: ScoreSheet,
    /// Why the mouse gave up, if it did.
    pub gave_up: Option<MouseError>,
}

/// One step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefereedStep {
    /// What the mouse wanted.
    pub order: Order,
    /// What came of it.
    pub event: Ruling,
    /// Where the mouse stood afterwards.
    pub cell: Cell,
}

/// Why there was no trial.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MouseTrialError {
    /// The maze will not do.
    #[error(transparent)]
    Referee(#[from] RefereeError),
    /// There is no mouse for this maze.
    #[error(transparent)]
    Mouse(#[from] MouseError),
    /// The mouse gave an order that the rules do not know.
    #[error("the mouse broke the rules")]
    Order(#[from] OrderError),
}

impl MouseTrial {
    /// Lets the mouse run until it is done, gives up or the time is over.
    ///
    /// # Errors
    /// If the referee refuses the maze or an order.
    pub fn play(maze: &Maze, mouse: &mut Driver<impl Search>) -> Result<Self, MouseTrialError> {
        let mut referee = Referee::new(maze)?;
        let mut steps = Vec::new();
        let mut gave_up = None;
        while !referee.is_over() {
            match mouse.next(referee.sight()) {
                Ok(order) => {
                    let event = referee.take(order)?;
                    let (cell, _) = referee.pose();
                    steps.push(RefereedStep { order, event, cell });
                }
                Err(error) => {
                    gave_up = Some(error);
                    break;
                }
            }
        }
        Ok(Self {
            steps,
            verdict: referee.verdict(),
            gave_up,
        })
    }
}
