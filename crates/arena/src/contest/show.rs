//! Shows a contestant: it learns a drawing, is put down in it, localizes, and drives to the goal
//! from there.

use tolman_maze::{Cell, Direction};
use tolman_robot::{Goal, Landmark, Standing, Task};

use super::contestant::Schooling;
use super::play::{Bout, Contest, ContestError, LearnRecord, LocateOutcome, Measured, Moment};
use crate::{BoxError, Outing};

/// Result of a [show](Contest::show).
#[derive(Clone, Debug)]
pub struct ShowRecord {
    /// Result of learning.
    pub learned: LearnRecord,
    /// Distance driven while learning, m.
    pub explored: f64,
    /// Result of localizing.
    pub found: FoundOut,
    /// Distance driven to the goal from there, m; `None` if it did not arrive.
    pub home: Option<f64>,
    /// Length of the shortest way to the goal from the cell where it then was, m.
    pub shortest: f64,
    /// Reason why it gave up on the way to the goal; empty if it did not.
    pub gave_up: String,
}

/// How a robot localized.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundOut {
    /// Its answer.
    pub outcome: LocateOutcome,
    /// Whether it stayed where it was put down. A system that only tracks its robot is put back.
    pub was_put_down: bool,
    /// Number of actions.
    pub actions: u32,
    /// Distance driven, m.
    pub metres: f64,
    /// Last time step of localizing, counted from the beginning.
    pub step: usize,
}

impl Contest<'_> {
    /// Plays the show and returns its result. Calls `watch` at every [`Moment`].
    ///
    /// The contestant learns the drawing and is put down at the first of its
    /// [places](Contest::put_downs). It localizes, and drives to the goal from there. A contestant
    /// that cannot be put down elsewhere is put back instead.
    ///
    /// # Errors
    /// [`ContestError`], also if the contestant [abstains](super::Contestant::abstains).
    pub fn show(
        &self,
        schooling: &Schooling,
        mut watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ShowRecord, ContestError> {
        if let Some(why) = self.contestant.abstains(self.maze, self.robot) {
            return Err(self.enter_error(why.into()));
        }
        let entered = self.contestant.enter(self, schooling);
        let entered = entered.map_err(|source| self.enter_error(source))?;
        let mut bout = Bout::new(self, entered);
        watch(&*bout.outing, Moment::Begun);
        let learned = bout.learn(None, &mut watch);
        let explored = learned.driven * bout.scale();
        let here = Contest { starts: 1, ..*self }.put_downs();
        let Some([here, _]) = here.first() else {
            return Err(self.put_error("the drawing has no cell but the goal".into()));
        };
        let shown = bout.find_out_and_go_home(*here, &mut watch);
        let (found, home) = shown.map_err(|source| self.put_error(source))?;
        watch(&*bout.outing, Moment::Over);
        Ok(ShowRecord {
            learned,
            explored,
            found,
            home: home.metres,
            shortest: home.shortest,
            gave_up: home.gave_up,
        })
    }
}

/// The way to the goal of a robot that was not lifted.
struct WentHome {
    metres: Option<f64>,
    shortest: f64,
    gave_up: String,
}

impl Bout<'_> {
    fn find_out_and_go_home(
        &mut self,
        start: (Cell, Direction),
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> Result<(FoundOut, WentHome), BoxError> {
        let before = self.outing.path().last().copied();
        let mut found = FoundOut {
            outcome: LocateOutcome::Wrong,
            was_put_down: true,
            actions: 0,
            metres: 0.0,
            step: 0,
        };
        match (self.put_down(start)?, before) {
            (Standing::GaveUp { why }, Some(before)) => {
                self.put_back(before)?;
                found.was_put_down = false;
                found.outcome = LocateOutcome::Abstained { why };
            }
            _ => {
                watch(&*self.outing, Moment::PutDown);
                let most = Contest::LIMIT * self.corridors();
                let mut actions = 0;
                let see = |_: &dyn Outing, _| actions += 1;
                let driven = self.pursue(Task::Localize, most, None, see, watch);
                found.outcome = self.outcome(driven.end);
                (found.actions, found.metres) = (actions, driven.metres);
            }
        }
        found.step = self.outing.path().len() - 1;
        let cell = self.squares.cell_at(self.here());
        let shortest = self.maze.metres_to_goal(cell, self.squares.pitch);
        let most = Contest::LIMIT * shortest.max(self.squares.pitch);
        let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
        let driven = self.pursue(goal, most, None, |_, _| {}, watch);
        Ok((
            found,
            WentHome {
                metres: driven.arrived,
                shortest,
                gave_up: driven.end.why().to_owned(),
            },
        ))
    }
}
