//! Input of an observer.

use alloc::vec::Vec;

use tolman_geom::PoseBox;

use super::{Action, Signature};

/// One move: "a sequence of actions ending with the robot in a distinguished place", reported at
/// its end.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObservedMove {
    /// The control routine.
    pub action: Action,
    /// Bounds that contain the true motion. They hold the displacement along the axes of the
    /// compass (x east, y north), m, and the heading, rad.
    ///
    /// A robot with odometry in its own axes turns it by its compass:
    /// `PoseBox::new(PointBox::ORIGIN, heading).transform(displacement)`.
    pub odometry: PoseBox,
    /// View of the place where the move ended.
    pub percept: Option<Signature>,
    /// Actions that the robot could try there.
    pub exits: Exits,
    /// Outcome of the move.
    pub outcome: MoveOutcome,
}

/// End of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MoveOutcome {
    /// The robot came to a distinctive place.
    Arrived,
    /// The action was not possible: the robot has not moved.
    Blocked,
}

/// Actions that the robot believes it can try. Used for plans, advice and the counts of links. A
/// place is not recognized by them, but in a static world they tell it from one nearby.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Exits {
    /// The robot cannot tell: any action may be possible.
    #[default]
    Unknown,
    /// The robot saw that exactly these actions are possible.
    Seen(Vec<Action>),
}

impl Exits {
    /// Returns whether an action may be possible.
    #[must_use]
    pub fn allow(&self, action: Action) -> bool {
        match self {
            Self::Unknown => true,
            Self::Seen(seen) => seen.contains(&action),
        }
    }
}

/// View and exits of the first place.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FirstPlace {
    /// View of the place.
    pub percept: Option<Signature>,
    /// Actions that could be tried.
    pub exits: Exits,
}
