//! Shows a contestant: it learns a drawing, is put down in it, localizes, and drives to the goal
//! from there.

use tolman_maze::{Cell, Direction};
use tolman_robot::{Goal, Landmark, Standing, Task};

use super::play::{
    Bout, Contest, ContestError, Driven, LearnRecord, LocateOutcome, Measured, Moment, Pursuit,
};
use crate::registry::Schooling;
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
    /// Distance driven to the goal from the place where the robot localized, m; `None` if the robot
    /// did not arrive.
    pub home: Option<f64>,
    /// Length of a shortest way from where it then was to the goal, m: at most `home`.
    pub shortest: f64,
    /// Reason why the system gave up on the way to the goal; empty if it did not.
    pub gave_up: String,
}

/// Result of localizing.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundOut {
    /// Answer of the system.
    pub outcome: LocateOutcome,
    /// Whether the robot stayed where it was put down. A system that only tracks its robot has it
    /// put back.
    pub was_put_down: bool,
    /// Number of actions.
    pub actions: u32,
    /// Distance driven, m.
    pub metres: f64,
    /// Last time step of localizing, counted from the beginning.
    pub step: usize,
}

impl Contest<'_> {
    /// Puts the contestant at the start.
    pub(super) fn bout(&self, schooling: &Schooling) -> Result<Bout, ContestError> {
        if let Some(why) = self.abstains() {
            return Err(self.enter_error(why.into()));
        }
        Ok(Bout::new(self, self.enter(schooling)?))
    }

    /// Plays the show and returns its result. Calls `watch` at every [`Moment`].
    ///
    /// The contestant learns the drawing and is put down at the first of its
    /// [places](Contest::put_downs). It localizes, and drives to the goal from there. A contestant
    /// that cannot be put down elsewhere is put back instead.
    ///
    /// # Errors
    /// [`ContestError`], also if the contestant [abstains](Self::abstains).
    pub fn show(
        &self,
        schooling: &Schooling,
        mut watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ShowRecord, ContestError> {
        let mut bout = self.bout(schooling)?;
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
#[derive(Clone, Debug, PartialEq)]
pub struct WayHome {
    /// Distance driven until the robot was at the goal, m; `None` if it did not arrive.
    pub metres: Option<f64>,
    /// Length of a shortest way from where it was to the goal, m: at most `metres`.
    pub shortest: f64,
    /// Reason why the system gave up; empty if it did not.
    pub gave_up: String,
}

impl Bout {
    fn find_out_and_go_home(
        &mut self,
        start: (Cell, Direction),
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> Result<(FoundOut, WayHome), BoxError> {
        let found = match self.put_down_or_back(start)? {
            Standing::GaveUp { why } => self.not_put_down(why),
            _ => {
                watch(&*self.outing, Moment::PutDown);
                let mut actions = 0;
                let pursuit = self.begin_to_localize();
                let driven = self.pursue(pursuit, |outing, _| {
                    actions += 1;
                    watch(outing, Moment::Acted);
                });
                self.found_out(driven, actions)
            }
        };
        let (pursuit, shortest) = self.begin_to_go_home();
        let driven = self.pursue(pursuit, |outing, _| watch(outing, Moment::Acted));
        Ok((found, WayHome::of(&driven, shortest)))
    }

    /// Puts the robot down in the middle of a cell and tells its system. Puts it back if the system
    /// gives up.
    pub(super) fn put_down_or_back(
        &mut self,
        start: (Cell, Direction),
    ) -> Result<Standing, BoxError> {
        let before = self.outing.path().last().copied();
        let standing = self.put_down(start)?;
        if let (Standing::GaveUp { .. }, Some(before)) = (&standing, before) {
            self.put_back(before)?;
        }
        Ok(standing)
    }

    /// Returns the result after the robot was put back.
    pub(super) fn not_put_down(&self, why: String) -> FoundOut {
        FoundOut {
            outcome: LocateOutcome::Abstained { why },
            was_put_down: false,
            actions: 0,
            metres: 0.0,
            step: self.outing.path().len() - 1,
        }
    }

    /// Begins to find out where the robot was put down.
    pub(super) fn begin_to_localize(&mut self) -> Pursuit {
        let most = Contest::LIMIT * self.corridors();
        self.set_out(Task::Localize, most, None)
    }

    /// Returns the result of localizing by this drive.
    pub(super) fn found_out(&self, driven: Driven, actions: u32) -> FoundOut {
        FoundOut {
            metres: driven.metres,
            outcome: self.outcome(driven.end),
            was_put_down: true,
            actions,
            step: self.outing.path().len() - 1,
        }
    }

    /// Begins the way to the goal. A shortest way has this length, m.
    pub(super) fn begin_to_go_home(&mut self) -> (Pursuit, f64) {
        let cell = self.squares.cell_at(self.here());
        let by_cells = self.maze.metres_to_goal(cell, self.squares.pitch);
        let most = Contest::most_home(by_cells, self.corridors());
        let radius = self.outing.robot().inner_radius();
        let shortest = self.outing.course().shortest_drive(self.here(), radius);
        let shortest = shortest.unwrap_or(by_cells);
        let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
        (self.set_out(goal, most, None), shortest)
    }
}

impl WayHome {
    pub(super) fn of(driven: &Driven, shortest: f64) -> Self {
        Self {
            metres: driven.arrived,
            // The way it drove is one, too: the search is as fine as its grid.
            shortest: driven
                .arrived
                .map_or(shortest, |driven| driven.min(shortest)),
            gave_up: driven.end.why().to_owned(),
        }
    }
}
