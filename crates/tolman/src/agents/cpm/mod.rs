//! CPM: an e-puck that reasons on common-pattern maps.
mod agent;
mod body;
mod common_patterns;
mod fragments;
mod walker;

pub use agent::*;
pub use body::{Body, Reckoned, SimulatedEpuck};
pub use common_patterns::{CommonPatterns, Grain, LearnError, wander};
pub use fragments::{TrueFragments, Way};
pub use walker::{Observation, Walk, WalkError, Walker, WalkerConfig};
