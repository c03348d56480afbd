//! CPM's e-puck in mazes: [`SimulatedEpuck`], the trials that are played with it, and what it
//! should have learned there. The system is `tolman_systems::cpm`.
//!
//! A [`CpmRun`] is the system with its robot, sent out. A [`CpmTrial`] plays both episodes on a
//! [course](epuck_course) in such a run and scores them by its [`TrueFragments`]. A [`Layout`] says
//! where the parts of a map lie. A [`PutDown`] is a trial of a robot that has to find out where it
//! is.

mod bends;
mod course;
mod covering_walk;
mod distinctness;
mod fragments;
mod known_map;
mod layout;
mod lesson;
mod map_right;
mod patience;
mod put_down;
mod robots;
mod run;
mod score;
mod spots;
mod survey;
mod trial;

pub use bends::BendLikeness;
pub use course::{CORRIDOR_WIDTH, epuck_course, epuck_course_on};
pub use covering_walk::covering_walk;
pub use distinctness::{Distinctness, WalkPair, distinctness};
#[cfg(test)]
pub(crate) use fragments::tests::LOOP;
pub use fragments::{TrueFragments, WayOut};
pub(crate) use fragments::{direction_of, ends_fragments, follow, landmark_at};
pub use layout::{Layout, Lie, OpenPort};
pub use lesson::{learn, learn_by, learn_on_pioneer};
pub use map_right::is_whole_map_right;
pub use patience::patience;
pub use put_down::{KnownMaze, PutDown, PutDownRecord};
pub use robots::{
    SimulatedEpuck, epuck, pioneer_as_epuck, ring_measures, slow_epuck, walker_config,
};
pub use run::CpmRun;
pub use score::Closures;
pub use survey::{SurveyedWalk, survey};
pub use trial::{CpmTrial, TrialRecord};
