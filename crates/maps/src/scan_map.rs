//! Places learned from scans and a compass, each of them once: a map that stops growing.

mod clearings;
mod config;
mod fit;
mod map;
mod wall_grid;

pub use clearings::{Clearings, WayToGap};
pub use config::ScanMapConfig;
pub use map::{Advance, ScanMap, ScanPlace};
pub use wall_grid::{GridRange, WallGrid};
