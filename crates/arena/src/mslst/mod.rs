//! MSLST: maze solving by learning state topologies (Tingle, Ball, Augat).
//!
//! "The MSLST algorithm uses a three-stage process to solve a maze, first using GNG to abstract perceptions of
//! the maze into discrete states, then by mapping the topology of those states within the maze into a graph,
//! and finally using that graph to localize a robot within the maze and find the most direct path to the
//! destination."
//!
//! - [`learn`] is Phases I and II: an [`MslstConfig`] and a course make a [`MslstMap`].
//! - [`Mslst`] is Phase III: the brain that navigates by one.
//! - [`MapFile`] keeps one, [`drawing`] shows it.

mod config;
mod learn;
mod map;
mod map_file;
mod navigate;
mod states;

pub use config::MslstConfig;
pub use learn::{LearnError, Learned, Survey, learn, learn_graph, scans};
pub use map::MslstMap;
pub use map_file::{MapFile, MapFileError};
pub use navigate::{Mslst, Situation};
pub use states::{States, StatesError};
