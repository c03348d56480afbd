use thiserror::Error;
use tolman_robot::{LaserSensing, SensesLandmarks, TurnTranslate};

use crate::BoxError;

/// Any robot with a laser: simulated, real, or in another process.
pub type AnyRobot =
    Box<dyn SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error = RobotFailure>>;

/// Reason why [any robot](AnyRobot) makes no step.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct RobotFailure(pub BoxError);
