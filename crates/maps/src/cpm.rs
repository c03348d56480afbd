//! CPM, the common-pattern map: path fragments between junctions, each a sequence of common
//! patterns.
//!
//! Kawewong, Honda, Tsuboyama, Hasegawa: "Reasoning on the Self-Organizing Incremental Associative
//! Memory for Online Robot Path Planning" (2010). In the order data flows:
//!
//! - a [`Dictionary`] holds the common patterns (CPs), which a quantizer has found; a [`PatternId`]
//!   is one of them;
//! - a [`Traversal`] is what a robot observed along one fragment, between two [`Sighting`]s of
//!   junctions, dead ends or landmarks;
//! - a [`Turn`] (Δ) is its turn at a junction;
//! - a [`CpMapper`] takes both in, as a [`CpMapperConfig`] says;
//! - the [`CpMap`] (ℳ) has the fragments and junctions; similar fragments, by [`FragmentMatching`],
//!   are one;
//! - a [`Plan`] is a way through it;
//! - a [`Localizer`] finds a robot on some maps after it was put down;
//! - a `MapFile` (feature `serde`) keeps a map with its dictionary;
//! - [`Environments`] recall the path and the environment of a sequence.
//!
//! ```
//! use tolman_maps::cpm::{
//!     MapUpdate, CpMapper, CpMapperConfig, Dictionary, Sighting, Traversal, Turn,
//! };
//!
//! let mut dictionary = Dictionary::new(1);
//! let wall = dictionary.learn(&[1.0], &[1.0], 0.1)?;
//! let door = dictionary.learn(&[0.0], &[0.0], 0.1)?;
//! // From one dead end to the other, and back.
//! let mut mapper = CpMapper::new(CpMapperConfig::online(), Sighting::plain(1))?;
//! let mut walk = |patterns: [_; 3]| {
//!     let (patterns, sighting) = (patterns.to_vec(), Sighting::plain(1));
//!     let walk = Traversal { patterns, motion: None, sighting, bearings: None };
//!     mapper.arrive(Turn::BACK, &walk, &dictionary)
//! };
//! assert_eq!(walk([wall, wall, door])?, MapUpdate::New);
//! assert_eq!(walk([door, wall, wall])?, MapUpdate::Known);
//! assert_eq!(mapper.map().fragments().len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod alignment;
mod beam;
mod bearings;
mod config;
mod cp_mapper;
mod detour;
mod doubt;
mod environments;
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

pub use alignment::Alignment;
pub use bearings::{Bearings, BearingsError};
pub use config::{Candidates, CpMapperConfig, Mapping};
pub use cp_mapper::{CpMapper, CpmError, MapUpdate};
pub use doubt::MapDoubt;
pub use environments::{Environments, RecallError, Recollection};
pub use localizer::{LocalizeError, Localizer, LocalizerConfig, Location};
pub use map::{CpMap, End, Fragment, FragmentId, Junction, JunctionId, Port, PortState, Sign};
#[cfg(feature = "serde")]
pub use map_file::{MapFile, MapFileError};
pub use pattern::{Dictionary, DictionaryError, PatternId, Version};
pub use plan::{Plan, PlanLeg};
pub use similarity::{FragmentMatching, Match, PatternDifference, Sense, Similarity, Span, Sum};
pub use theorem::theorem_1;
pub use traversal::{DeadReckoning, Sighting, Traversal};
pub use turn::{NoSuchTurn, Turn};
