use core::convert::Infallible;

use thiserror::Error;
use tolman_control::RingError;
use tolman_robot::Robot;
use tolman_sim::robots::RobotConfigError;
use tolman_sim::{PlaceError, StepError};
use tolman_systems::ActorError;

use crate::course::CourseError;
use crate::run::{InRun, Limited, LimitedError};

/// Reason why a run could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpisodeError {
    /// The robot cannot be built.
    #[error("the robot cannot be built; correct its configuration")]
    Robot(#[from] RobotConfigError),
    /// The robot cannot start where it was put.
    #[error("the robot cannot start there; choose another start")]
    Start(#[from] PlaceError),
    /// The layers do not fit the robot's ring.
    #[error("the layers do not fit the robot's ring of beams; change one of the two")]
    Layers(#[from] RingError),
    /// The mind cannot work on this course.
    #[error(transparent)]
    Course(#[from] CourseError),
    /// The course is too large for the oracle.
    #[error(
        "the oracle would have to plan on {nodes} nodes, more than its limit of {most}: choose a smaller maze"
    )]
    Policy {
        /// Number of nodes that the course needs.
        nodes: usize,
        /// Maximum number of nodes.
        most: usize,
    },
    /// A step could not be made.
    #[error("step {step} failed; correct the layer that chose its command")]
    Step {
        /// Number of the step, from 0.
        step: u32,
        /// The underlying error.
        source: ActorError<LimitedError<StepError>, Infallible>,
    },
}

/// Returns the error that the simulator refused the command of time step `step`.
pub(crate) const fn step_failed(step: u32, source: StepError) -> EpisodeError {
    let source = ActorError::Robot(LimitedError::Robot(source));
    EpisodeError::Step { step, source }
}

/// Returns the error for a run that broke off at the robot's next step.
pub(crate) fn broken(
    robot: &Limited<impl Robot>,
    source: ActorError<LimitedError<StepError>, Infallible>,
) -> EpisodeError {
    let step = robot.steps();
    EpisodeError::Step { step, source }
}
