//! Sends every system into every kind of world, and judges all systems by the same truth.
//!
//! A [`Contest`] sends one [system](crate::registry::SystemEntry) into one drawing. The contestant
//! learns. It is put down
//! somewhere and localizes; then it is put down somewhere else and drives to the goal. Its map is
//! compared with the drawing's [`TrueGraph`], which it never sees.
//! A [`SteppedContest`] is played action by action. In a [`RatExperiment`] an experimenter moves
//! doors and watches which way is taken.

mod claim;
mod condition;
mod errands;
mod evidence;
mod floor;
mod floor_graph;
mod ideal;
mod judgement;
mod paint;
mod play;
mod rats;
mod show;
mod sites;
mod spots;
mod stepped;
mod true_graph;
mod wanderers;
mod watched;
mod whereabouts;

pub use claim::Claim;
pub use condition::Condition;
pub(crate) use condition::with_doors;
pub use errands::{Errands, ErrandsRecord, NoLandmarks};
pub use evidence::{Evidence, TrueVisits};
pub use floor::FloorContest;
pub use judgement::MapJudgement;
pub use play::{
    Contest, ContestError, ContestRecord, Home, LearnRecord, LocateOutcome, Located, Moment,
};
pub use rats::{RatExperiment, RatRecord, RatStep, RatTrip};
pub use show::{FoundOut, ShowRecord, WayHome};
pub use stepped::{SteppedContest, TaskRecord};
pub use true_graph::{PlaceRule, TrueGraph, TrueWay};
pub use watched::{WatchedError, WatchedRun};
pub use whereabouts::PlaceVisit;

pub(crate) use true_graph::is_straight;
