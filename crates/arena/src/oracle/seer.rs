use core::ops::ControlFlow;

use rand_chacha::ChaCha8Rng;
use tolman_control::{Drive, Driven, Outcome};
use tolman_maze::Direction;
use tolman_robot::{Landmark, Robot, SensesLandmarks, Standing};

use super::Oracle;
use crate::pioneer::CoursePioneer;
use crate::run::Limited;

/// An oracle that drives to the goal. No robot outside the arena can be asked for the truth.
#[derive(Debug)]
pub(crate) struct Seer<'a> {
    oracle: &'a mut Oracle,
    drive: Drive<ChaCha8Rng>,
    last: Option<(Direction, Outcome)>,
}

impl<'a> Seer<'a> {
    /// Returns an oracle whose actions `drive` carries out.
    pub(crate) const fn new(oracle: &'a mut Oracle, drive: Drive<ChaCha8Rng>) -> Self {
        Self {
            oracle,
            drive,
            last: None,
        }
    }

    /// Makes the next action. `see` is shown every time step.
    pub(crate) fn act(
        &mut self,
        robot: &mut Limited<CoursePioneer>,
        mut see: impl FnMut(&Driven<'_, Limited<CoursePioneer>>),
    ) -> Result<Standing, <Limited<CoursePioneer> as Robot>::Error> {
        if robot.landmark() == Some(Landmark::Goal) {
            return Ok(Standing::Done);
        }
        let action = self.oracle.choose(robot.robot().truth().pose, self.last);
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
