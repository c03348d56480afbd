//! A better MSLST: it merges places while its map grows, and believes in places rather than in strings of states.

mod config;
mod explorer;
mod map;
mod navigator;
mod reckoning;

pub use config::BetterConfig;
pub use explorer::BetterExplorer;
pub use map::BetterMap;
pub use navigator::BetterNavigator;
