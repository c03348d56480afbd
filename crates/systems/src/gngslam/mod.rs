//! A place map from camera, sonar and odometry.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system using Growing Neural Gas", 2006.
//! In the order data flows:
//!
//! 1. A [`Wanderer`] drives any robot that turns and translates and takes snapshots: straight on until something is near, then
//!    elsewhere by chance (section 3.2). Where a leg ends it takes a [`PlaceRecord`](tolman_maps::place_map::PlaceRecord).

mod dead_reckoned;
mod wanderer;

use dead_reckoned::DeadReckoned;
pub use wanderer::{Wanderer, WandererConfig, WandererError};
