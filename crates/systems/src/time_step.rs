use tolman_control::{Driven, Outcome};
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{Compass, Landmark, Ranges, Scan, SensesLandmarks};

/// One time step as a [`Brain`](crate::Brain) observes it: what the robot sensed at its end, and the high-level
/// action it belongs to.
///
/// A log that does not name the actions cannot fill [`doing`](Self::doing), and a brain learns nothing of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeStep {
    /// The ranges in the robot's frame, m; `None` for a drop-out.
    pub scan: Option<Scan>,
    /// The compass heading; `None` for a drop-out.
    pub heading: Option<Heading>,
    /// The landmark the robot stands at.
    pub landmark: Option<Landmark>,
    /// What the robot was doing.
    pub doing: Doing,
}

/// What a robot was doing in a time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doing {
    /// Nothing: it has been put down, before the first action or anew.
    PutDown,
    /// An action that goes on.
    UnderWay(Direction),
    /// An action that ended with this step.
    Ended(Direction, Outcome),
}

impl Doing {
    /// Returns what the robot did in a time step that was just driven.
    pub const fn of<R>(step: &Driven<'_, R>) -> Self {
        match step.ends {
            Some(outcome) => Self::Ended(step.action, outcome),
            None => Self::UnderWay(step.action),
        }
    }
}

impl TimeStep {
    /// Returns what `robot` senses at the end of a time step in which it was `doing` that.
    pub fn of<R>(robot: &R, doing: Doing) -> Self
    where
        R: SensesLandmarks,
        R::Sensing: Ranges + Compass,
    {
        let sensing = robot.sensing();
        Self {
            scan: sensing.scan().cloned(),
            heading: sensing.heading(),
            landmark: robot.landmark(),
            doing,
        }
    }
}
