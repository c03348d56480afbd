//! CPM: "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path
//! Planning" (Kawewong, Honda, Tsuboyama, Hasegawa 2010).
//!
//! In the order of the paper: a [`CpmRobot`] senses landmarks; a [`Walker`] is its layers 0 and 1 and
//! its observations (sections 3.2 and 4.1). [`CommonPatterns`] are the dictionary it learns in the
//! learning maze (section 4.1). [`Layer3`] maps, reasons and plans on `tolman_maps::cpm` (sections 4.2,
//! 4.3 and 6), as its [`Explorer`] decides. [`Reasoner`] plays the paper's episodes. A [`MapFile`] keeps
//! a map. [`find_out`] tells a robot that was put down somewhere where it is (section 8).

mod common_patterns;
mod config;
mod decision;
mod episode;
mod explorer;
mod layer3;
mod map_file;
mod mode;
mod preset;
mod reasoner;
mod reckoned;
mod ring_as_epuck;
mod robot;
mod search;
mod system;
mod walker;
mod walker_config;
mod whereabouts;

pub use common_patterns::{CommonPatterns, LearnError, Lesson, soinn, wander};
pub use config::{CpmConfig, Onward};
pub use decision::{Aim, Decision, Done, Leg};
pub use episode::{Begun, Episode};
pub use explorer::Explorer;
pub use layer3::{Experience, Layer3, Step};
pub use map_file::{MapFile, MapFileError};
pub use mode::Mode;
pub use preset::Preset;
pub use reasoner::{Reasoner, ReasonerError};
pub use reckoned::Reckoned;
pub use ring_as_epuck::{RingAsEpuck, RingMeasures};
pub use robot::CpmRobot;
pub use search::{RestingSearch, Search, find_out};
pub use system::{Cpm, CpmFailure, ObserveError};
pub use walker::{BeforePlace, Observation, Prospect, RestingWalker, Walk, WalkError, Walker};
pub use walker_config::{EpuckMeasures, HeadingBy, WalkerConfig};
pub use whereabouts::{Approach, Whereabouts, WhereaboutsError};
