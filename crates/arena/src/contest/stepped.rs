//! Plays a contest action by action, as fast as the caller wants, with the next task chosen on the
//! way.

use core::fmt;

use tolman_geom::Point;
use tolman_maze::{Cell, Direction};
use tolman_robot::Standing;

use super::evidence::TrueVisits;
use super::play::{Bout, Contest, ContestError, LearnRecord, Pursuit};
use super::show::{FoundOut, WayHome};
use crate::Outing;
use crate::registry::{Schooling, SystemEntry};
use crate::run::TaskEnd;

/// A contestant in a drawing, made to act one action at a time.
///
/// It explores, is put down somewhere, finds out where, and goes to the goal, in any order. In the
/// order of [`Contest::show`] the run is the same, bit for bit.
pub struct SteppedContest {
    contestant: &'static dyn SystemEntry,
    world: String,
    bout: Bout,
    stage: Stage,
}

/// Task under way.
enum Stage {
    Idle,
    Learning(Pursuit, TrueVisits),
    Localizing(Pursuit, u32),
    GoingHome(Pursuit, f64),
}

/// Result of a task of a [`SteppedContest`].
#[derive(Clone, Debug)]
pub enum TaskRecord {
    /// The system has learned.
    Learned(Box<LearnRecord>),
    /// Result of localizing a robot that was put down.
    Found(FoundOut),
    /// The system has gone to the goal, or not.
    Home(WayHome),
}

impl SteppedContest {
    /// Puts the contestant at the start of the drawing.
    ///
    /// # Errors
    /// [`ContestError::Enter`], also if the contestant [abstains](Contest::abstains).
    pub fn new(contest: &Contest<'_>, schooling: &Schooling) -> Result<Self, ContestError> {
        Ok(Self {
            contestant: contest.contestant,
            world: contest.name.to_owned(),
            bout: contest.bout(schooling)?,
            stage: Stage::Idle,
        })
    }

    /// Returns the contestant with its robot.
    #[must_use]
    pub fn outing(&self) -> &dyn Outing {
        &*self.bout.outing
    }

    /// Returns whether a task is under way.
    #[must_use]
    pub const fn is_busy(&self) -> bool {
        !matches!(self.stage, Stage::Idle)
    }

    /// Begins to learn the drawing. A task under way is [stopped](Self::stop).
    pub fn explore(&mut self) {
        self.stop();
        let pursuit = self.bout.begin_to_learn(None);
        self.stage = Stage::Learning(pursuit, TrueVisits::default());
    }

    /// Returns the cell at `point`, m, and a way out of it; `None` if the cell is walled in.
    #[must_use]
    pub fn cell_at(&self, point: Point) -> Option<(Cell, Direction)> {
        let cell = self.bout.squares.cell_at(point);
        let mut ways = self.bout.maze.neighbours(cell);
        ways.next().map(|(way, _)| (cell, way))
    }

    /// Lifts the robot, puts it down in the middle of a cell, tells its system, and begins to
    /// localize. A task under way is [stopped](Self::stop). Returns the result at once if the
    /// system gives up: it follows its robot, so it is put back.
    ///
    /// # Errors
    /// [`ContestError::PutDown`] if the robot cannot stand there.
    pub fn put_down(&mut self, start: (Cell, Direction)) -> Result<Option<FoundOut>, ContestError> {
        self.stop();
        let standing = self.bout.put_down_or_back(start);
        let standing = standing.map_err(|source| ContestError::PutDown {
            contestant: self.contestant.title(),
            world: self.world.clone(),
            source,
        })?;
        if let Standing::GaveUp { why } = standing {
            return Ok(Some(self.bout.not_put_down(why)));
        }
        self.stage = Stage::Localizing(self.bout.begin_to_localize(), 0);
        Ok(None)
    }

    /// Begins the way to the goal. A task under way is [stopped](Self::stop).
    pub fn go_home(&mut self) {
        self.stop();
        let (pursuit, shortest) = self.bout.begin_to_go_home();
        self.stage = Stage::GoingHome(pursuit, shortest);
    }

    /// Makes the next action of the task under way and returns the task's result once it has ended.
    pub fn act(&mut self) -> Option<TaskRecord> {
        let end = match &mut self.stage {
            Stage::Idle => None,
            Stage::Learning(pursuit, visits) => self.bout.go_on(pursuit, |outing, before| {
                visits.note(outing, before);
            }),
            Stage::Localizing(pursuit, actions) => {
                *actions += 1;
                self.bout.go_on(pursuit, |_, _| {})
            }
            Stage::GoingHome(pursuit, _) => self.bout.go_on(pursuit, |_, _| {}),
        }?;
        self.ended(end)
    }

    /// Ends the task under way as if its time were up and returns its result; `None` without one.
    pub fn stop(&mut self) -> Option<TaskRecord> {
        self.ended(TaskEnd::OutOfTime)
    }

    /// Ends the task under way by `end` and returns its result, or `None` if there is none.
    fn ended(&mut self, end: TaskEnd) -> Option<TaskRecord> {
        match core::mem::replace(&mut self.stage, Stage::Idle) {
            Stage::Idle => None,
            Stage::Learning(pursuit, visits) => {
                let driven = self.bout.driven(&pursuit, end);
                Some(TaskRecord::Learned(Box::new(
                    self.bout.learned(driven, visits),
                )))
            }
            Stage::Localizing(pursuit, actions) => {
                let driven = self.bout.driven(&pursuit, end);
                Some(TaskRecord::Found(self.bout.found_out(driven, actions)))
            }
            Stage::GoingHome(pursuit, shortest) => {
                let driven = self.bout.driven(&pursuit, end);
                Some(TaskRecord::Home(WayHome::of(&driven, shortest)))
            }
        }
    }
}

impl fmt::Debug for SteppedContest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SteppedContest")
            .field("contestant", &self.contestant)
            .field("world", &self.world)
            .finish_non_exhaustive()
    }
}
