//! Orders of a mouse to the referee.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use tolman_planners::moves::MouseStep;

/// Answer of a mouse to a reading of its sensors: a rotation, then a movement.
///
/// It is written as the paper's test program takes it, with one key for each:
///
/// ```
/// use tolman_systems::micromouse::{Movement, Order, Rotation};
///
/// let order = Order { rotation: Rotation::Degrees(-90), movement: Movement::Cells(3) };
/// assert_eq!(serde_json::to_string(&order)?, r#"{"rotation":-90,"movement":3}"#);
/// assert_eq!(serde_json::to_string(&Order::RESET)?, r#"{"rotation":"Reset","movement":"Reset"}"#);
/// assert_eq!(serde_json::from_str::<Order>(r#"{"rotation":"Reset","movement":"Reset"}"#)?, Order::RESET);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// First the mouse turns.
    pub rotation: Rotation,
    /// Movement after the turn.
    pub movement: Movement,
}

/// Turn before the move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Rotation {
    /// Degrees clockwise. The referee obeys −90, 0 and 90 and ignores all others.
    Degrees(i32),
    /// Half of a reset.
    Reset(Reset),
}

/// Distance to drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Movement {
    /// Number of cells ahead, or back if negative. The referee moves the mouse by three at most.
    Cells(i32),
    /// Half of a reset.
    Reset(Reset),
}

/// The word `Reset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Reset {
    /// Order to be put back to the start.
    Reset,
}

impl Order {
    /// End of the first run, once the mouse has been at the goal: put it back to the start.
    pub const RESET: Self = Self {
        rotation: Rotation::Reset(Reset::Reset),
        movement: Movement::Reset(Reset::Reset),
    };

    /// Returns a rotation in degrees and a movement in cells.
    #[must_use]
    pub const fn new(degrees: i32, cells: i32) -> Self {
        Self {
            rotation: Rotation::Degrees(degrees),
            movement: Movement::Cells(cells),
        }
    }
}

impl From<MouseStep> for Order {
    fn from(step: MouseStep) -> Self {
        Self::new(step.turn.degrees(), step.cells.into())
    }
}

/// Reason why the paper's test program breaks off at an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OrderError {
    /// Only one of rotation and movement is `Reset`.
    #[error(
        "the movement is \"Reset\" but the rotation is {degrees}: say \"Reset\" for both, or a number of cells"
    )]
    HalfReset {
        /// The rotation.
        degrees: i32,
    },
}
