//! CPM: "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path Planning" (Kawewong, Honda, Tsuboyama,
//! Hasegawa 2010), on an e-puck.
//!
//! In the order of the paper: a [`Body`] is the robot, with [`Landmark`](tolman_maps::cpm::Landmark)s; a [`Walker`] its layers 0 and 1 and its
//! observations (sections 3.2 and 4.1); [`CommonPatterns`] the dictionary it learns in the learning maze (section 4.1); [`Cpm`] layer 3, which maps,
//! reasons and plans on `tolman_maps::cpm` (sections 4.2, 4.3 and 6). A [`Trial`] plays both episodes in the maze of a [`Venue`] and scores them by its
//! [`TrueFragments`]. An [`Errand`] is one episode, of which a [`MapFile`] can be kept; a [`Layout`] says where the parts of a map lie.
//! [`find_out`] is how a robot that was put down somewhere learns where it is, [`PutDown`] a trial of it; a
//! [`RoundTrip`] is the way to the goal, back by untried fragments, and there again.

#[cfg(test)]
mod adversity;
mod agent;
mod body;
mod common_patterns;
mod distinctness;
pub mod drawing;
mod errand;
mod fragments;
mod known_map;
mod layout;
mod map_file;
mod put_down;
mod robot;
mod round_trip;
mod score;
mod spots;
mod survey;
mod trial;
mod venue;
mod walker;
mod whereabouts;

pub use agent::{AgentError, Cpm, Episode, Step};
pub use body::{Body, Reckoned, SimulatedEpuck};
pub use common_patterns::{CommonPatterns, LearnError, wander};
pub use distinctness::{Distinctness, Pair, distinctness};
pub use errand::Errand;
pub use fragments::{TrueFragments, Way};
pub use layout::{Course, Fit, Layout, OpenPort};
pub use map_file::{MapFile, MapFileError, System};
pub use put_down::{KnownMaze, PutDown, PutDownRecord};
pub use robot::{epuck, idealized_epuck, slow_epuck, soinn, walker_config};
pub use round_trip::RoundTrip;
pub use score::Closures;
pub use survey::{Surveyed, survey};
pub(crate) use trial::placed;
pub use trial::{Mode, Record, Trial, TrialError, learn};
pub use venue::Venue;
pub use walker::{HeadingBy, Observation, Walk, WalkError, Walker, WalkerConfig};
pub use whereabouts::{Approach, Whereabouts, WhereaboutsError, find_out};
