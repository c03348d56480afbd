//! A robot with range sensors that drives straight on until something is near, and then turns
//! elsewhere.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system
//! using Growing Neural Gas", section 3.2. In the order data flows:
//!
//! 1. [`RunningMean`]: the mean of the last three readings of each sensor, as noise is coped with.
//! 2. [`GoAhead`], the top layer: straight on. [`StopNear`] corrects it: nothing nearer than its
//!    threshold, which depends on where the sensor looks. [`StopAtBump`] corrects both: what no
//!    sensor heard has been touched.
//! 3. [`UntilNear`]: carries that out on a [`Robot`](tolman_robot::Robot), and turns it to where
//!    the way is clear, or by an angle.
//!
//! The caller decides where to turn.

mod go_ahead;
mod near_limits;
mod running_mean;
mod stop_at_bump;
mod stop_near;
mod until_near;

pub use go_ahead::GoAhead;
pub use near_limits::NearLimits;
pub use running_mean::RunningMean;
pub use stop_at_bump::StopAtBump;
pub use stop_near::StopNear;
pub use until_near::{TurnByEnd, TurnEnd, UntilNear, UntilNearConfig};

use tolman_robot::TurnTranslate;

/// Proposal of the layers so far for this time step of a leg.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LegStep {
    /// Motor command for this time step.
    pub command: TurnTranslate,
    /// End of the leg before this step; `None` while it goes on.
    pub ends: Option<LegEnd>,
}

impl LegStep {
    /// Returns the step that ends the leg: the robot stands still.
    #[must_use]
    pub const fn end(ends: LegEnd) -> Self {
        Self {
            command: TurnTranslate::STOP,
            ends: Some(ends),
        }
    }
}

/// End of a leg, a drive straight on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LegEnd {
    /// Something is near.
    Near,
    /// Something was touched that no sensor had heard.
    Bumped,
    /// The leg took as many time steps as it may.
    TooLong,
}
