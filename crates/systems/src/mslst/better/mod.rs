//! A better MSLST, on the same scans, compass and motors, with the encoders that the paper's robot had and did not use.
//!
//! - [`BetterExplorer`] learns: it merges places while its map grows, and goes where the map has gaps until it has none.
//! - [`BetterMap`] is what it has learned, made ready: the robot tries every action in thought from everywhere it can stand, and so
//!   knows what the ways to the goal cost a robot that misses.
//! - [`BetterNavigator`] navigates: it believes in places rather than in strings of states, and does what costs least on average over all it believes.
//!
//! Its layers see scans [straightened](tolman_control::straightened): by a laser that errs by 2 % Orient turns to and fro.

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
