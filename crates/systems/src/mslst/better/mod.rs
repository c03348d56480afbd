//! A better MSLST: it merges places while its map grows, and believes in places rather than in strings of states.

mod config;
mod explorer;
mod imagined;
mod map;
mod navigator;
mod reckoning;
mod rehearsal;

pub use config::{BetterConfig, Motors};
pub use explorer::BetterExplorer;
pub use map::BetterMap;
pub use navigator::BetterNavigator;
