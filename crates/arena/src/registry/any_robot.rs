use thiserror::Error;
use tolman_robot::{LaserSensing, RobotMeasures, SensesLandmarks, TurnTranslate};
use tolman_systems::{AnyOnRobot, ForRobotError};

use crate::BoxError;

/// Any robot with a laser: simulated, real, or in another process.
pub type AnyRobot =
    Box<dyn SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error = RobotFailure>>;

/// Reason why [any robot](AnyRobot) makes no step.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct RobotFailure(pub BoxError);

/// Puts a system on a robot of these measures. All random numbers follow from the seed.
pub type ForRobot = fn(&RobotMeasures, AnyRobot, u64) -> Result<Box<dyn AnyOnRobot>, ForRobotError>;

/// Returns a system that was put on its robot, as any is.
pub(super) fn any<S: AnyOnRobot + 'static>(
    put: Result<S, ForRobotError>,
) -> Result<Box<dyn AnyOnRobot>, ForRobotError> {
    Ok(Box::new(put?))
}
