use core::error::Error;

use thiserror::Error as ThisError;
use tolman_geom::IntervalError;
use tolman_maps::diktiometry::SignatureError;
use tolman_maze::Direction;

/// Reason why a control routine cannot be carried out.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum RoutineError<E: Error + 'static> {
    /// The robot refuses a command.
    #[error("the robot refuses a command; correct its driver")]
    Robot(#[source] E),
    /// A sensor is of no use.
    #[error(transparent)]
    Sense(#[from] SenseError),
    /// A reading is not a number.
    #[error("the odometry is not a number; check the wheels' encoders")]
    Reading(#[from] IntervalError),
    /// The robot's view is not a valid signature.
    #[error("the image gives no signature; check the camera")]
    Signature(#[from] SignatureError),
    /// The robot broke off: it stands at the landmark that it seeks.
    #[error("the robot stands at the landmark that it seeks")]
    Found,
    /// No place came in sight.
    #[error("after {steps} time steps the way {direction} has led to no place")]
    Lost {
        /// Direction of the way.
        direction: Direction,
        /// Number of time steps made on the way.
        steps: u32,
    },
}

/// Reason why the routines cannot use a sensor.
#[derive(Clone, Copy, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum SenseError {
    /// A sensor that the routines need gave no values.
    #[error("the {sensor} gave nothing for some time steps in a row; check that the robot has one")]
    Blind {
        /// Name of the sensor.
        sensor: &'static str,
    },
    /// The laser does not look all round.
    #[error(
        "the laser has {ranges} ranges, {spacing_deg:.1}° apart; \
         the routines need beams spread evenly over the full circle"
    )]
    NotRound {
        /// Number of ranges.
        ranges: usize,
        /// Bearing from one beam to the next, degrees.
        spacing_deg: f64,
    },
}
