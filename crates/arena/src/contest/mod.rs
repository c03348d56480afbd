//! Every system in every kind of world, judged by one truth.
//!
//! A [`Contest`] sends one [`Contestant`] into one drawing. It learns, is put down somewhere and
//! finds out where, is put down somewhere else and goes to the goal. Its map is judged by the
//! drawing's [`TrueGraph`], which it never sees.
//! A [`SteppedContest`] goes at the pace of who looks.

mod condition;
mod contestant;
#[cfg(test)]
mod entry_tests;
mod ideal;
mod judgement;
mod paint;
mod pathfinder;
mod play;
mod show;
mod stepped;
mod true_graph;
mod wanderers;
mod whereabouts;

pub use condition::Condition;
pub use contestant::{ContestRobot, Contestant, Schooling};
pub use judgement::{MapJudgement, judge};
pub use play::{
    Claim, Contest, ContestError, ContestRecord, Home, LearnRecord, LocateOutcome, Located, Moment,
};
pub use show::{FoundOut, ShowRecord, WayHome};
pub use stepped::{SteppedContest, TaskRecord};
pub use true_graph::{PlaceRule, TrueGraph, TrueWay};
pub use whereabouts::PlaceVisit;
