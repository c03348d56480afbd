use core::convert::Infallible;

use tolman_systems::{Brain, RolledStep, TimeStep};

use crate::oracle::Oracle;

/// A brain of any kind that takes in all it observes.
pub type AnyBrain = dyn Brain<Observation = TimeStep, Error = Infallible>;

/// A brain of any kind that uses wheel encoders.
pub type AnyRollingBrain = dyn Brain<Observation = RolledStep, Error = Infallible>;

/// The brain or system that chooses the actions in an [episode](crate::episode).
#[derive(Debug)]
pub enum Mind {
    /// One that perceives.
    Brain(Box<AnyBrain>),
    /// A brain that also perceives its wheels' odometry.
    Rolling(Box<AnyRollingBrain>),
    /// An oracle, which is shown the truth.
    Oracle(Box<Oracle>),
}
