//! CPM's e-puck in mazes: [`SimulatedEpuck`], the trials that are played with it, and what it
//! should have learned there. The system is `tolman_systems::cpm`.
//!
//! A [`CpmTrial`] plays both episodes on a [course](epuck_course) and scores them by its
//! [`TrueFragments`]. A [`Layout`] says where the parts of a map lie. An [`Exploration`] is a maze
//! walked to its end. A [`PutDown`] is a trial of a robot that has to find out where it is. A
//! [`RoundTrip`] is the way to the goal, back by untried fragments, and there again.

#[cfg(test)]
mod adversity;
mod bends;
mod course;
mod covering_walk;
mod distinctness;
mod exploration;
mod fragments;
mod known_map;
mod layout;
mod map_right;
mod patience;
#[cfg(test)]
mod pioneer;
mod pursue;
mod put_down;
mod robots;
mod round_trip;
mod score;
mod spots;
mod survey;
mod trial;
#[cfg(test)]
mod wire;

pub use bends::BendLikeness;
pub use course::{CORRIDOR_WIDTH, epuck_course, epuck_course_on};
pub use covering_walk::covering_walk;
pub use distinctness::{Distinctness, WalkPair, distinctness};
pub use exploration::Exploration;
pub(crate) use fragments::landmark_at;
#[cfg(test)]
pub(crate) use fragments::tests::LOOP;
pub use fragments::{TrueFragments, WayOut};
pub use layout::{Fit, Layout, Lie, OpenPort};
pub use map_right::is_whole_map_right;
pub use patience::patience;
pub use pursue::pursue;
pub use put_down::{KnownMaze, PutDown, PutDownRecord};
pub use robots::{
    SimulatedEpuck, epuck, idealized_epuck, ring_measures, slow_epuck, walker_config,
};
pub use round_trip::RoundTrip;
pub use score::Closures;
pub use survey::{SurveyedWalk, survey};
pub use trial::{CpmTrial, CpmTrialError, TrialRecord, learn, learn_by};
