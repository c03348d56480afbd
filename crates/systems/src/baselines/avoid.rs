use core::convert::Infallible;

use rand::{Rng, RngExt};
use tolman_control::Outcome;
use tolman_maze::Direction;
use tolman_robot::Mapper;

use crate::{Brain, Doing, TimeStep};

/// MSLST's Avoid brain: "wanders randomly (but does not backtrack unless it reaches a dead end, and
/// does not repeat failed actions)".
///
/// Failed actions are forgotten as soon as one succeeds. If all three others have failed, the robot
/// is in a dead end and turns back. If that fails too, it forgets all failures and tries again.
#[derive(Clone, Debug, Default)]
pub struct AvoidBrain {
    pub(super) travelling: Option<Direction>,
    pub(super) failed: Vec<Direction>,
}

impl AvoidBrain {
    /// Takes in the robot's last action and its outcome, even if another brain chose the action.
    pub(crate) fn learn(&mut self, doing: Doing) {
        match doing {
            Doing::PutDown => *self = Self::default(),
            Doing::UnderWay(_) => {}
            Doing::Ended(action, Outcome::Completed) => {
                self.travelling = Some(action);
                self.failed.clear();
            }
            Doing::Ended(action, _) => self.failed.push(action),
        }
    }

    /// Draws the next action.
    pub(crate) fn wander(&mut self, rng: &mut dyn Rng) -> Direction {
        let back = self.travelling.map(Direction::opposite);
        let untried: Vec<Direction> = Direction::ALL
            .into_iter()
            .filter(|action| !self.failed.contains(action))
            .collect();
        let onward: Vec<Direction> = untried
            .iter()
            .copied()
            .filter(|action| Some(*action) != back)
            .collect();

        let choices = if !onward.is_empty() {
            onward
        } else if !untried.is_empty() {
            untried
        } else {
            self.failed.clear();
            Direction::ALL.to_vec()
        };
        choices[rng.random_range(0..choices.len() as u32) as usize]
    }
}

impl Mapper for AvoidBrain {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        self.learn(seen.doing);
        Ok(())
    }
}

impl Brain for AvoidBrain {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.wander(rng)
    }
}
