//! A place map from camera, sonar and odometry.
//!
//! Goldhoorn, Stadman, Eldering: "Implementation of a Simultaneous Localization and Mapping system using Growing Neural Gas", 2006.
//! In the order data flows:
//!
//! 1. A [`Wanderer`] drives any robot that turns and translates and takes snapshots: straight on until something is near, then
//!    elsewhere by chance (section 3.2). Where a leg ends it takes a [`PlaceRecord`](tolman_maps::place_map::PlaceRecord).
//! 2. [`OnlineSlam`] is what the paper's section 6 asks for: it learns while it drives, and corrects its pose by the places that it
//!    has learned ([`tolman_maps::place_graph`]).

mod online;
mod route;
mod wanderer;

pub use online::{OnlineSlam, OnlineSlamConfig, OnlineSlamError};
pub use wanderer::{Wanderer, WandererConfig, WandererError};
