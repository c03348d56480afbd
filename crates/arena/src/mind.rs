use core::convert::Infallible;

use tolman_systems::{Brain, TimeStep};

use crate::oracle::Oracle;

/// A brain of whichever kind that takes in all it observes.
pub type AnyBrain = dyn Brain<Observation = TimeStep, Error = Infallible>;

/// Whoever chooses the actions in an [episode](crate::episode).
#[derive(Debug)]
pub enum Mind {
    /// One that perceives.
    Brain(Box<AnyBrain>),
    /// One that is shown the truth.
    Oracle(Box<Oracle>),
}
