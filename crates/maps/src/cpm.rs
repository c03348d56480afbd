//! CPM, the common-pattern map: path fragments between junctions, each a sequence of common patterns.
//!
//! Kawewong, Honda, Tsuboyama, Hasegawa: "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot
//! Path Planning" (2010). In the order data flows:
//!
//! - a [`Dictionary`] holds the common patterns (CPs), which a quantizer has found; a [`PatternId`] is one of them;
//! - a [`Traversal`] is what a robot observed along one fragment, between two [`Sighting`]s of junctions, dead ends or landmarks;
//! - a [`Turn`] (Δ) is what it did at a junction;
//! - an [`Explorer`] takes both in and decides what to do next, as a [`CpmConfig`] says;
//! - the [`CpMap`] (ℳ) has the fragments and junctions; similar fragments, by [`Matching`], are one;
//! - a [`Plan`] is a way through it;
//! - a [`Localizer`] finds where on some maps a robot is that was put somewhere;
//! - a `MapFile` (feature `serde`) keeps a map with its dictionary;
//! - [`Environments`] recall the path and the environment that a sequence belongs to.
//!
//! [`world`] has mazes of corridors and junctions to try all this in without a robot, in microseconds.
//!
//! ```
//! use rand::SeedableRng;
//! use rand_chacha::ChaCha8Rng;
//! use tolman_maps::cpm::{Aim, CpmConfig, Decision, Done, Explorer, Landmark};
//! use tolman_maps::cpm::world::{MazeConfig, Noise, Outcome, Reckoning, Rover, World};
//!
//! let mut rng = ChaCha8Rng::seed_from_u64(1);
//! let world = World::random(&MazeConfig::small(), &mut rng)?;
//! let mut rover = Rover::new(&world, Noise::NONE, Reckoning::None);
//! let mut explorer = Explorer::new(CpmConfig::online(), rover.sighting())?;
//! let done = loop {
//!     match explorer.decide(Aim::Find(Landmark::Goal), &mut rng) {
//!         Decision::Done(done) => break done,
//!         Decision::Go(leg) => match rover.go(leg.turn, leg.give_up_after, &mut rng)? {
//!             Outcome::Arrived(walk) => {
//!                 explorer.arrive(leg.turn, &walk, world.dictionary())?;
//!             }
//!             Outcome::TurnedBack(patterns) => {
//!                 explorer.turned_back(leg.turn, patterns.len() as u32)?;
//!             }
//!         },
//!     }
//! };
//! assert_eq!(done, Done::Reached);
//! assert!(explorer.map().has_goal());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod alignment;
mod beam;
mod bearings;
mod config;
mod environments;
mod explorer;
mod geometry;
mod hypothesis;
mod index;
mod localizer;
mod map;
#[cfg(feature = "serde")]
mod map_file;
mod mapper;
mod nodes;
mod pattern;
mod plan;
mod scores;
mod similarity;
mod theorem;
mod traversal;
mod turn;
mod unify;
pub mod world;

pub use alignment::Alignment;
pub use bearings::{Bearings, BearingsError};
pub use config::{Candidates, CpmConfig, Mapping, Onward};
pub use environments::{Environments, RecallError, Recollection};
pub use explorer::{Aim, Arrival, CpmError, Decision, Done, Explorer, Leg};
pub use localizer::{LocalizeError, Localizer, LocalizerConfig, Location};
pub use map::{CpMap, End, Fragment, FragmentId, Junction, JunctionId, Port, PortState, Sign};
#[cfg(feature = "serde")]
pub use map_file::{MapFile, MapFileError};
pub use pattern::{Dictionary, DictionaryError, PatternId, Version};
pub use plan::{Plan, PlanLeg};
pub use similarity::{Difference, Match, Matching, Sense, Similarity, Span, Sum};
pub use theorem::theorem_1;
pub use tolman_robot::Landmark;
pub use traversal::{Motion, Sighting, Traversal};
pub use turn::{NoSuchTurn, Turn};
pub use unify::Conflict;
