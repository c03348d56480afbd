use alloc::string::String;

use tolman_geom::{Heading, Point};

use crate::{Landmark, Mapper, Robot};

/// A mapper that also drives.
///
/// It is made with its seed and derives one random stream for each of its parts. What it needs of a
/// robot stands in the bounds of its implementation, as [capabilities](crate::Ranges) and never as
/// the name of a robot.
pub trait System<R: Robot>: Mapper {
    /// Reason why the system cannot continue: the robot's error, or a refusal of one of its parts.
    type Failure;

    /// Makes the next action of `task` with `robot`, a few time steps, and returns how the task
    /// stands. The number of its time steps is bounded.
    ///
    /// # Errors
    /// If the robot fails or the system cannot go on with it.
    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure>;

    /// Tells the system that its robot was lifted and put down, perhaps elsewhere, and returns
    /// whether it can continue. The default gives up, because the system follows its robot and
    /// cannot find it again.
    fn put_down(&mut self) -> Standing {
        Standing::gave_up("it follows its robot, and cannot find out where it is put down")
    }

    /// Returns where it believes its robot to look, if it has a heading of its own; `None` if it
    /// takes the compass's.
    fn heading(&self) -> Option<Heading> {
        None
    }

    /// Returns the system's situation in a few words for a viewer, such as `lost`; empty if there
    /// is nothing to say.
    fn words(&self) -> String {
        String::new()
    }
}

/// Task of a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Task {
    /// Learn the world until the system knows all of it, or as much as it wants to.
    Explore,
    /// Go to a goal.
    Reach(Goal),
    /// Find the robot's place on the map.
    Localize,
}

/// Goal of a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// A landmark, which the robot senses on arrival.
    Landmark(Landmark),
    /// A place of the system's own map, by id.
    Place(u32),
    /// A point of the system's own map, m.
    Point(Point),
}

/// State of a task after an action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The task goes on.
    UnderWay,
    /// The task is done, as far as the system can tell.
    Done,
    /// The system gave up.
    GaveUp {
        /// Reason, in a sentence without a full stop.
        why: String,
    },
}

impl Standing {
    /// Returns the standing of a system that gave up, with the reason `why`.
    pub fn gave_up(why: impl Into<String>) -> Self {
        Self::GaveUp { why: why.into() }
    }
}
