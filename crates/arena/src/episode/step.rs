use tolman_control::{Driven, Outcome};
use tolman_maze::Direction;
use tolman_robot::{Guess, Mapper, TurnTranslate};
use tolman_systems::Brain;

use crate::mind::AnyBrain;
use crate::pioneer::CoursePioneer;
use crate::run::Limited;

/// One time step of a run, as it has just been made.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The action it belongs to.
    pub action: Direction,
    /// The brain that chose it; `None` for an oracle.
    pub brain: Option<&'a AnyBrain>,
    /// What the motors were told.
    pub command: TurnTranslate,
    /// How the action ended with this step; `None` while it goes on.
    pub ends: Option<Outcome>,
    /// The robot as it is now.
    pub robot: &'a CoursePioneer,
}

impl<'a> Step<'a> {
    pub(super) fn of(
        brain: Option<&'a AnyBrain>,
        driven: &Driven<'a, Limited<CoursePioneer>>,
    ) -> Self {
        Self {
            action: driven.action,
            brain,
            command: driven.command,
            ends: driven.ends,
            robot: driven.robot.robot(),
        }
    }

    /// Returns in a few words what the brain made of its situation when it chose the action; empty if there is
    /// nothing to say.
    #[must_use]
    pub fn words(&self) -> String {
        self.brain.map_or_else(String::new, Brain::words)
    }

    /// Returns where the brain believed the robot to be when it chose the action, the likeliest first; empty if it
    /// does not ask.
    #[must_use]
    pub fn belief(&self) -> Vec<Guess> {
        self.brain.map_or_else(Vec::new, Mapper::belief)
    }
}
