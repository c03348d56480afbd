//! A map of places from the laser scans of any way, such as a log's: it watches and cannot drive.
//!
//! Scans are matched to earlier ones, which gives odometry that hardly drifts. The scans of a
//! stretch are combined to a ring that looks all round. The
//! [`CorridorDetector`](tolman_control::CorridorDetector) reads it, as robots do. Where it finds no
//! corridor there is a place. The ways that lead on tell whether it is a junction, a bend, a dead
//! end or a room. A place is recognized if the map has one there and both look alike; two
//! recognitions must agree. Nothing is compared between places.
//!
//! Every other mapper of places learns from the same places: a [`SiteMapper`] passes it the ways
//! between them ([`OfSites`]).

mod config;
mod mapper;
mod place;
mod site_mapper;
mod site_way;

pub use config::PlacesConfig;
pub use mapper::{PlacesError, PlacesMapper};
pub use place::{SiteKind, SitePlace};
pub use site_mapper::{OfSites, SiteMapper, SiteMapperError};
pub use site_way::{Site, SiteStep, SiteWay};
