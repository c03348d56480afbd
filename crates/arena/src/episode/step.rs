use tolman_control::{Driven, Outcome};
use tolman_maze::Direction;
use tolman_robot::{Guess, TurnTranslate};

use crate::mind::{AnyBrain, AnyRollingBrain};
use crate::pioneer::CoursePioneer;
use crate::run::Limited;

/// One time step of a run, as it has just been made.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Action under way in this time step.
    pub action: Direction,
    /// Brain that chose the action.
    pub brain: Chooser<'a>,
    /// Command of the motors.
    pub command: TurnTranslate,
    /// Outcome of the action if it ended with this step; `None` while it goes on.
    pub ends: Option<Outcome>,
    /// Robot after the time step.
    pub robot: &'a CoursePioneer,
}

/// Brain that chose an action.
#[derive(Clone, Copy, Debug)]
pub enum Chooser<'a> {
    /// A brain that perceives scans and headings.
    Brain(&'a AnyBrain),
    /// A brain that also perceives its wheels' odometry.
    Rolling(&'a AnyRollingBrain),
    /// An oracle, which has no belief.
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

    /// Returns the brain's view of its situation when it chose the action, in a few words. Empty if
    /// there is nothing to say.
    #[must_use]
    pub fn words(&self) -> String {
        match self.brain {
            Chooser::Oracle => String::new(),
            Chooser::Brain(brain) => brain.words(),
            Chooser::Rolling(brain) => brain.words(),
        }
    }

    /// Returns the positions at which the brain believed the robot to be when it chose the action.
    /// The likeliest is first; empty if the brain does not localize.
    #[must_use]
    pub fn belief(&self) -> Vec<Guess> {
        match self.brain {
            Chooser::Oracle => Vec::new(),
            Chooser::Brain(brain) => brain.belief(),
            Chooser::Rolling(brain) => brain.belief(),
        }
    }
}
