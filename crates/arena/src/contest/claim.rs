use tolman_robot::Task;

use crate::Outing;
use crate::run::TaskEnd;

/// A system's verdict on its own map, which never sees the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// Right and complete: the system says that it is done.
    Right,
    /// Wrong or unfinished: the system gave up, or doubts its map.
    Wrong,
    /// Undecided: its time ran out, or being done says nothing about its map.
    Undecided,
}

/// Probability of being right below which a system doubts its map.
const EVEN: f64 = 0.5;

impl Claim {
    /// Returns the verdict of a system whose learning ended by `end`. `claims` says whether being
    /// done means that it claims its map is that of the whole world.
    #[must_use]
    pub fn of(end: &TaskEnd, claims: bool, outing: &dyn Outing) -> Self {
        Self::by(end, claims, outing.doubt().as_deref(), outing.certainty())
    }

    /// Returns the same verdict of a system with this doubt and this certainty.
    #[must_use]
    pub fn by(end: &TaskEnd, claims: bool, doubt: Option<&str>, certainty: Option<f64>) -> Self {
        match end {
            TaskEnd::GaveUp { .. } => Self::Wrong,
            _ if certainty.is_some_and(|certainty| certainty < EVEN) => Self::Wrong,
            TaskEnd::Done if doubt.is_some() => Self::Wrong,
            TaskEnd::Done if claims => Self::Right,
            TaskEnd::Done | TaskEnd::OutOfTime => Self::Undecided,
        }
    }

    /// Returns why a system calls its map wrong or unfinished after `task`, in a sentence without a
    /// full stop; `None` if it does not. The map of a robot that only had to reach a goal need not
    /// be whole.
    #[must_use]
    pub fn complaint(end: &TaskEnd, task: Task, outing: &dyn Outing) -> Option<String> {
        match (end, task) {
            (TaskEnd::GaveUp { why }, _) => Some(why.clone()),
            (TaskEnd::OutOfTime, _) => {
                Some("it ran out of time before it had learned all".to_owned())
            }
            (TaskEnd::Done, Task::Explore) if Self::of(end, false, outing) == Self::Wrong => {
                let why = "by its own account it is more likely wrong than right";
                Some(outing.doubt().unwrap_or_else(|| why.to_owned()))
            }
            (TaskEnd::Done, _) => None,
        }
    }
}
