//! The one loop that lets a system drive a robot.

use core::time::Duration;

use thiserror::Error;
use tolman_robot::{Landmark, Robot, SensesLandmarks, Standing, Stopping, System, Task};

/// Returns the time since some moment. Results do not depend on it.
pub type Stopwatch = fn() -> Duration;

/// A robot in a run: its time steps are counted and limited, and it stands still when the run is
/// over.
#[derive(Debug)]
pub struct Limited<R: Robot> {
    robot: Stopping<R>,
    steps: u32,
    step_limit: u32,
    stopwatch: Option<Stopwatch>,
    /// Duration of the robot's own time steps so far, while times are measured.
    stepping: Duration,
}

/// Reason why a robot cannot make a step in a run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LimitedError<E> {
    /// The run has as many time steps as it may have.
    #[error("the run reached its limit of {steps} time steps; raise the limit")]
    OutOfTime {
        /// Number of time steps made.
        steps: u32,
    },
    /// The robot failed.
    #[error(transparent)]
    Robot(#[from] E),
}

impl<R: Robot> Limited<R> {
    /// Returns `robot`, which may make `step_limit` time steps.
    pub const fn new(robot: R, step_limit: u32) -> Self {
        Self {
            robot: Stopping::new(robot),
            steps: 0,
            step_limit,
            stopwatch: None,
            stepping: Duration::ZERO,
        }
    }

    /// Limits the robot to `steps` further time steps.
    pub const fn allow(&mut self, steps: u32) {
        self.step_limit = self.steps.saturating_add(steps);
    }

    /// Measures from now on how long the robot itself takes.
    pub const fn measure(&mut self, stopwatch: Stopwatch) {
        self.stopwatch = Some(stopwatch);
    }

    /// Returns the time by the stopwatch; `None` without one.
    pub fn now(&self) -> Option<Duration> {
        self.stopwatch.map(|now| now())
    }

    /// Returns the time that the robot itself took, while it was measured; for a simulated robot,
    /// that of the simulator.
    pub const fn stepping(&self) -> Duration {
        self.stepping
    }

    /// Returns the robot.
    pub fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        self.robot.robot_mut()
    }

    /// Returns the most time steps that it may make.
    pub const fn step_limit(&self) -> u32 {
        self.step_limit
    }
}

impl<R: Robot> Robot for Limited<R> {
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = LimitedError<R::Error>;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), Self::Error> {
        if self.is_out_of_time() {
            return Err(LimitedError::OutOfTime { steps: self.steps });
        }
        let began = self.now();
        self.robot.step(command)?;
        if let (Some(began), Some(now)) = (began, self.now()) {
            self.stepping += now.saturating_sub(began);
        }
        self.steps += 1;
        Ok(())
    }
}

impl<R: SensesLandmarks> SensesLandmarks for Limited<R> {
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

/// A robot in a run, with what drives it.
pub trait InRun {
    /// Returns the number of time steps that the robot has made.
    fn steps(&self) -> u32;

    /// Returns whether the robot may make no further step.
    fn is_out_of_time(&self) -> bool;
}

impl<R: Robot> InRun for Limited<R> {
    fn steps(&self) -> u32 {
        self.steps
    }

    fn is_out_of_time(&self) -> bool {
        self.steps >= self.step_limit
    }
}

/// End of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ended {
    /// Result of the task.
    pub end: TaskEnd,
    /// Number of actions that were begun.
    pub actions: u32,
    /// Number of time steps made in all runs of this robot so far.
    pub steps: u32,
}

/// Result of a run's task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TaskEnd {
    /// The system says that it is done.
    Done,
    /// The system gave up.
    GaveUp {
        /// Reason in the system's words.
        why: String,
    },
    /// The robot made as many time steps as it may.
    OutOfTime,
}

impl TaskEnd {
    /// Returns the reason for which the system gave up; empty if it did not.
    #[must_use]
    pub fn why(&self) -> &str {
        match self {
            Self::GaveUp { why } => why,
            Self::Done | Self::OutOfTime => "",
        }
    }
}

/// Lets `system` pursue `task` with `robot` until it is done, gives up, or is out of time. Returns
/// how it ended.
///
/// # Errors
/// The system's error if the robot fails or it cannot go on.
pub fn run<R: Robot, S: System<Limited<R>>>(
    robot: &mut Limited<R>,
    system: &mut S,
    task: Task,
) -> Result<Ended, S::Failure> {
    until_done(robot, |robot| system.act(robot, task))
}

/// Calls `act` repeatedly with `robot`, or its driver, until the task is done or given up, or the
/// robot is out of time. Returns how it ended.
///
/// # Errors
/// The error of `act` if the robot fails or it cannot go on.
pub fn until_done<D: InRun + ?Sized, E>(
    robot: &mut D,
    mut act: impl FnMut(&mut D) -> Result<Standing, E>,
) -> Result<Ended, E> {
    let mut actions = 0;
    let end = loop {
        if robot.is_out_of_time() {
            break TaskEnd::OutOfTime;
        }
        actions += 1;
        match act(robot) {
            Ok(Standing::UnderWay) => {}
            Ok(Standing::Done) => break TaskEnd::Done,
            Ok(Standing::GaveUp { why }) => break TaskEnd::GaveUp { why },
            // It had to break off in the middle of an action.
            Err(_) if robot.is_out_of_time() => break TaskEnd::OutOfTime,
            Err(failure) => return Err(failure),
        }
    };
    Ok(Ended {
        end,
        actions,
        steps: robot.steps(),
    })
}

/// Number of actions in a run whose steps are actions.
struct Actions {
    made: u32,
    most: u32,
}

impl InRun for Actions {
    fn steps(&self) -> u32 {
        self.made
    }

    fn is_out_of_time(&self) -> bool {
        self.made >= self.most
    }
}

/// Calls `act` repeatedly until the task is done or given up, or `most` actions are made. Returns
/// how it ended. This is [`until_done`] for runs that are limited by their actions in place of time
/// steps, such as a mouse's orders or a robot's looks.
///
/// # Errors
/// The error of `act`.
pub fn within<E>(most: u32, mut act: impl FnMut() -> Result<Standing, E>) -> Result<Ended, E> {
    until_done(&mut Actions { made: 0, most }, |actions| {
        let standing = act()?;
        actions.made += 1;
        Ok(standing)
    })
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use tolman_robot::{Goal, Guess, MapView, Mapper};

    use super::*;

    /// A robot on a rail.
    #[derive(Debug, Default)]
    struct Cart {
        at: f64,
        told: Vec<f64>,
    }

    impl Robot for Cart {
        type Command = f64;
        type Sensing = f64;
        type Error = Infallible;

        fn sensing(&self) -> &f64 {
            &self.at
        }

        fn step(&mut self, command: &f64) -> Result<(), Infallible> {
            self.at += command;
            self.told.push(*command);
            Ok(())
        }
    }

    /// Rolls ahead three steps at a time until it is 7 m along.
    struct Roller;

    impl Mapper for Roller {
        type Observation = ();
        type Error = Infallible;

        fn observe(&mut self, _seen: &()) -> Result<(), Infallible> {
            Ok(())
        }

        fn map(&self) -> MapView {
            MapView::default()
        }

        fn belief(&self) -> Vec<Guess> {
            Vec::new()
        }
    }

    impl<R: Robot<Command = f64, Sensing = f64>> System<R> for Roller {
        type Failure = R::Error;

        fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, R::Error> {
            if task == Task::Localize {
                let why = "it has no map".to_owned();
                return Ok(Standing::GaveUp { why });
            }
            for _ in 0..3 {
                robot.step(&1.0)?;
                if *robot.sensing() >= 7.0 {
                    return Ok(Standing::Done);
                }
            }
            Ok(Standing::UnderWay)
        }
    }

    const REACH: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

    #[test]
    fn a_robot_that_is_out_of_time_may_be_allowed_more() {
        let mut robot = Limited::new(Cart::default(), 0);
        assert!(robot.is_out_of_time() && robot.step(&1.0).is_err());
        robot.allow(2);
        assert!(robot.step(&1.0).is_ok() && robot.step(&1.0).is_ok());
        assert!(robot.is_out_of_time() && robot.step(&1.0).is_err());
        assert_eq!(robot.steps(), 2);
    }

    #[test]
    fn a_run_may_be_limited_by_its_actions() {
        let mut made = 0;
        let mut act = |most, last: Result<Standing, &'static str>| {
            made = 0;
            within(most, || {
                made += 1;
                if made == 3 {
                    return last.clone();
                }
                Ok(Standing::UnderWay)
            })
        };
        let ended = act(2, Ok(Standing::Done)).unwrap();
        assert_eq!((ended.end, ended.actions), (TaskEnd::OutOfTime, 2));
        let ended = act(3, Ok(Standing::Done)).unwrap();
        assert_eq!((ended.end, ended.actions), (TaskEnd::Done, 3));
        assert_eq!(act(3, Err("it failed")), Err("it failed"));
    }

    #[test]
    fn a_run_ends_as_its_system_says_or_at_its_limit_and_the_robot_stands_still() {
        for (task, limit, end, actions, steps) in [
            (REACH, 100, TaskEnd::Done, 3, 7),
            (REACH, 5, TaskEnd::OutOfTime, 2, 5),
            (REACH, 6, TaskEnd::OutOfTime, 2, 6),
            (
                Task::Localize,
                5,
                TaskEnd::GaveUp {
                    why: "it has no map".to_owned(),
                },
                1,
                0,
            ),
        ] {
            let mut cart = Cart::default();
            let mut robot = Limited::new(&mut cart, limit);
            let ended = run(&mut robot, &mut Roller, task).unwrap();
            drop(robot);
            assert_eq!(
                ended,
                Ended {
                    end,
                    actions,
                    steps
                }
            );
            assert_eq!(cart.told.len() as u32, steps + 1);
            assert_eq!(cart.told.last(), Some(&0.0));
        }
    }
}
