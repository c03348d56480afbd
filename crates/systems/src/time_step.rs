use tolman_control::{Driven, Outcome};
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{
    Bumps, Compass, Landmark, Odometry, Ranges, Robot, Rolls, Scan, SensesLandmarks,
};

/// One time step as a [`Brain`](crate::Brain) observes it: the readings at its end, and the
/// high-level action to which it belongs.
///
/// A log without the actions cannot fill [`doing`](Self::doing), and a brain learns nothing from
/// it.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeStep {
    /// The ranges in the robot's frame, m; `None` for a drop-out.
    pub scan: Option<Scan>,
    /// The compass heading; `None` for a drop-out.
    pub heading: Option<Heading>,
    /// Landmark at which the robot stands.
    pub landmark: Option<Landmark>,
    /// Activity of the robot.
    pub doing: Doing,
}

/// A [`TimeStep`] of a robot with wheel encoders and a bumper.
#[derive(Clone, Debug, PartialEq)]
pub struct RolledStep {
    /// The time step: readings and activity.
    pub step: TimeStep,
    /// Odometry of the step; `None` for a drop-out.
    pub odometry: Option<Odometry>,
    /// Whether the body touched something in the step; `None` without a bumper.
    pub bump: Option<bool>,
}

/// View that a brain has of a robot at the end of a time step.
pub trait OfStep<R>: Sized {
    /// Returns the observation of `robot` while it is `doing` that.
    fn of_step(robot: &R, doing: Doing) -> Self;
}

impl<R> OfStep<R> for TimeStep
where
    R: SensesLandmarks,
    R::Sensing: Ranges + Compass,
{
    fn of_step(robot: &R, doing: Doing) -> Self {
        Self::of(robot, doing)
    }
}

impl<R> OfStep<R> for RolledStep
where
    R: Robot + SensesLandmarks,
    R::Sensing: Ranges + Compass + Rolls + Bumps,
{
    fn of_step(robot: &R, doing: Doing) -> Self {
        Self {
            step: TimeStep::of(robot, doing),
            odometry: robot.sensing().odometry(),
            bump: robot.sensing().bump(),
        }
    }
}

/// Activity of a robot in a time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doing {
    /// None: the robot has been put down, before the first action or again.
    PutDown,
    /// An action in progress.
    UnderWay(Direction),
    /// An action that ended with this step.
    Ended(Direction, Outcome),
}

impl Doing {
    /// Returns the activity in a time step that was just driven.
    pub const fn of<R>(step: &Driven<'_, R>) -> Self {
        match step.ends {
            Some(outcome) => Self::Ended(step.action, outcome),
            None => Self::UnderWay(step.action),
        }
    }
}

impl TimeStep {
    /// Returns the readings of `robot` at the end of a time step in which it was `doing` that.
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
