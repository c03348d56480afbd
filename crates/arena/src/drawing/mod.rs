//! Draws learned maps over their worlds, for reports and the command.

pub mod cpm;
pub mod diktiometry;
pub mod mslst;
mod places;
mod plan;

pub use places::places_over_world;
pub use plan::plan_of_course;
