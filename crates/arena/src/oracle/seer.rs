use core::convert::Infallible;
use core::ops::ControlFlow;

use rand_chacha::ChaCha8Rng;
use tolman_control::{Drive, Driven, Outcome};
use tolman_maze::Direction;
use tolman_robot::{
    Goal, Guess, Landmark, MapView, Mapper, Robot, SensesLandmarks, Standing, System, Task,
    TurnTranslate,
};

use super::Oracle;
use crate::pioneer::CoursePioneer;
use crate::run::Watched;

/// An oracle that drives. It is a system of the arena alone: no real robot can be asked for the truth.
#[derive(Debug)]
pub(crate) struct Seer<'a, S> {
    oracle: &'a mut Oracle,
    drive: Drive<ChaCha8Rng>,
    last: Option<(Direction, Outcome)>,
    see: S,
}

impl<'a, S> Seer<'a, S> {
    /// Returns an oracle whose actions `drive` carries out. `see` is shown every time step.
    pub(crate) const fn new<R>(oracle: &'a mut Oracle, drive: Drive<ChaCha8Rng>, see: S) -> Self
    where
        S: FnMut(&Driven<'_, R>),
    {
        Self {
            oracle,
            drive,
            last: None,
            see,
        }
    }
}

/// It has nothing to learn.
impl<S> Mapper for Seer<'_, S> {
    type Observation = ();
    type Error = Infallible;

    fn observe(&mut self, _seen: &()) -> Result<(), Infallible> {
        Ok(())
    }

    fn map(&self) -> MapView {
        MapView::default()
    }

    fn belief(&self) -> Vec<Guess> {
        Vec::new()
    }
}

impl<'c, F, S> System<Watched<CoursePioneer<'c>, F>> for Seer<'_, S>
where
    F: FnMut(&CoursePioneer<'c>, &TurnTranslate),
    S: FnMut(&Driven<'_, Watched<CoursePioneer<'c>, F>>),
{
    type Failure = <Watched<CoursePioneer<'c>, F> as Robot>::Error;

    fn act(
        &mut self,
        robot: &mut Watched<CoursePioneer<'c>, F>,
        task: Task,
    ) -> Result<Standing, Self::Failure> {
        if task != Task::Reach(Goal::Landmark(Landmark::Goal)) {
            return Ok(Standing::gave_up(
                "an oracle knows the way to the goal and nothing else",
            ));
        }
        if robot.landmark() == Some(Landmark::Goal) {
            return Ok(Standing::Done);
        }
        let action = self.oracle.choose(robot.robot().truth().pose, self.last);
        let see = &mut self.see;
        let outcome = self.drive.carry_out(robot, action, |step| {
            see(step);
            match step.robot.landmark() {
                Some(Landmark::Goal) => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        })?;
        self.last = outcome.map(|outcome| (action, outcome));
        Ok(match outcome {
            Some(_) => Standing::UnderWay,
            None => Standing::Done,
        })
    }
}
