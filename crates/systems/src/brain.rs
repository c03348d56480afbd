use core::fmt::Debug;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::{Goal, Mapper, Standing, Task};

/// Reason of a system that was sent to a point and knows places alone.
pub(crate) const NO_POINTS: &str = "it goes to places and landmarks, not to points between them";

/// Chooses high-level actions from its observations, such as [time steps](crate::TimeStep). It
/// knows no robot: an [`Actor`](crate::Actor) lets it drive one that senses what it
/// [observes](crate::OfStep).
pub trait Brain: Mapper + Debug {
    /// Returns the next action. It is called after the brain has observed that an action ended or
    /// the robot was put down.
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction;

    /// Takes note of the task that is asked for, before it is asked how that stands. A brain whose
    /// actions do not depend on it ignores it.
    fn aim(&mut self, _task: Task) {}

    /// Returns the state of `task`, as far as the brain can tell. The caller decides whether a goal
    /// is reached: the robot then senses its landmark.
    ///
    /// A brain without a map can be sent to landmarks only.
    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Reach(Goal::Landmark(_)) => Standing::UnderWay,
            Task::Reach(Goal::Place(_) | Goal::Point(_)) => {
                Standing::gave_up("it has no map that names places")
            }
            Task::Explore => Standing::gave_up("it learns no map"),
            Task::Localize => Standing::gave_up("it has no map to find itself on"),
        }
    }

    /// Returns whether the brain's layers see scans [straightened](tolman_control::straightened),
    /// for lasers that err. By default they see raw scans.
    fn sees_straight(&self) -> bool {
        false
    }

    /// Returns the brain's view of its situation at its last choice, in a few words, such as
    /// `lost`. Empty if there is nothing to say.
    fn words(&self) -> String {
        String::new()
    }
}

impl<B: Brain + ?Sized> Brain for &mut B {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        (**self).choose(rng)
    }

    fn aim(&mut self, task: Task) {
        (**self).aim(task);
    }

    fn standing(&self, task: Task) -> Standing {
        (**self).standing(task)
    }

    fn sees_straight(&self) -> bool {
        (**self).sees_straight()
    }

    fn words(&self) -> String {
        (**self).words()
    }
}
