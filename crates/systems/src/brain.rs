use core::fmt::Debug;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::{Goal, Mapper, Standing, Task};

/// Chooses high-level actions from its observations, such as [time steps](crate::TimeStep). It
/// knows no robot: an [`Actor`](crate::Actor) lets it drive one that senses what it
/// [observes](crate::OfStep).
pub trait Brain: Mapper + Debug {
    /// Returns the next action. It is called after the brain has observed that an action ended or
    /// the robot was put down.
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction;

    /// Returns the state of `task`, as far as the brain can tell. The caller decides whether a goal
    /// is reached: the robot then senses its landmark.
    ///
    /// A brain without a map can be sent to landmarks only.
    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Reach(Goal::Landmark(_)) => Standing::UnderWay,
            Task::Reach(Goal::Place(_)) => Standing::gave_up("it has no map that names places"),
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
