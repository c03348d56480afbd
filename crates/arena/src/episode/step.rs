use tolman_control::{Driven, Outcome};
use tolman_maze::Direction;
use tolman_robot::{Guess, TurnTranslate};

use crate::mind::{AnyBrain, AnyRollingBrain};
use crate::pioneer::CoursePioneer;
use crate::run::Limited;

/// One time step of a run, as it has just been made.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The action it belongs to.
    pub action: Direction,
    /// The brain that chose it.
    pub brain: Chooser<'a>,
    /// Command of the motors.
    pub command: TurnTranslate,
    /// Outcome of the action if it ended with this step; `None` while it goes on.
    pub ends: Option<Outcome>,
    /// The robot as it is now.
    pub robot: &'a CoursePioneer,
}

/// The brain that chose an action.
#[derive(Clone, Copy, Debug)]
pub enum Chooser<'a> {
    /// A brain that perceives.
    Brain(&'a AnyBrain),
    /// One that perceives what its wheels rolled, too.
    Rolling(&'a AnyRollingBrain),
    /// An oracle, which believes nothing.
    Oracle,
}

impl<'a> Step<'a> {
    pub(super) fn of(brain: Chooser<'a>, driven: &Driven<'a, Limited<CoursePioneer>>) -> Self {
        Self {
            action: driven.action,
            brain,
            command: driven.command,
            ends: driven.ends,
            robot: driven.robot.robot(),
        }
    }

    /// Returns in a few words what the brain made of its situation when it chose the action; empty
    /// if there is nothing to say.
    #[must_use]
    pub fn words(&self) -> String {
        match self.brain {
            Chooser::Oracle => String::new(),
            Chooser::Brain(brain) => brain.words(),
            Chooser::Rolling(brain) => brain.words(),
        }
    }

    /// Returns the positions at which the brain believed the robot to be when it chose the action.
    /// The likeliest is first; empty if the brain does not ask.
    #[must_use]
    pub fn belief(&self) -> Vec<Guess> {
        match self.brain {
            Chooser::Oracle => Vec::new(),
            Chooser::Brain(brain) => brain.belief(),
            Chooser::Rolling(brain) => brain.belief(),
        }
    }
}
