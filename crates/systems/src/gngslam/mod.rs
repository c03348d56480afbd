//! A place map from camera, sonar and odometry.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system
//! using Growing Neural Gas", 2006. In the order data flows:
//!
//! 1. A [`Wanderer`] drives any robot that turns and translates and takes snapshots: straight on
//!    until something is near, then in a random direction (section 3.2). At the end of each leg it
//!    takes a [`PlaceRecord`](tolman_maps::place_map::PlaceRecord).
//! 2. [`OfflineSlam`] lets it wander, and learns a map of all records at once (section 3.4): the
//!    paper's system.
//! 3. A [`PlacePilot`] drives to a node of that map.
//! 4. [`OnlineSlam`] does what the paper's section 6 asks for. It learns while it drives, and
//!    corrects its pose by the places that it has learned ([`tolman_maps::place_graph`]). A
//!    [`MapFile`] keeps them.

mod frontier;
mod map_file;
mod of_sites;
mod offline;
mod online;
mod place_pilot;
mod route;
mod sighting;
mod snapshot_robot;
mod wanderer;

pub use map_file::{MapFile, MapFileError};
pub use of_sites::PlaceGraphOfSites;
pub use offline::{OfflineSlam, OfflineSlamConfig, OfflineSlamError, OfflineSlamFailure};
pub use online::{ExplorationPolicy, OnlineSlam, OnlineSlamConfig, OnlineSlamError};
pub use place_pilot::{PlacePilot, PlacePilotConfig, PlacePilotError};
pub use sighting::LandmarkSighting;
pub use snapshot_robot::SnapshotRobot;
pub use wanderer::{Wanderer, WandererConfig, WandererError};
