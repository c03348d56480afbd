//! Places learned from scans and a compass, each of them once: a map that stops growing.

mod clearings;
mod config;
mod fit;
mod map;
mod standpoints;
mod wall_grid;
mod whereabouts;

pub use clearings::{Clearings, WayToGap};
pub use config::ScanMapConfig;
pub use map::{Advance, ScanMap, ScanPlace};
pub use standpoints::Standpoints;
pub use wall_grid::{GridRange, WallGrid};
pub use whereabouts::Whereabouts;
