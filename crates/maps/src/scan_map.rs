//! A map of places, learned from scans, a compass and the odometry. It has each place once, so it
//! stops growing.
//!
//! In the order data flows:
//!
//! 1. A [`ScanMap`] takes in each [advance](Advance) of the robot with the scan at its end. It fits
//!    the scan to the known walls and so corrects the position. Then it draws new walls on a
//!    [`WallGrid`], and finds the place or adds it.
//! 2. [`Clearings`] are the ground where the robot can stand, with the [ways](GroundWay) to where
//!    it has not been.
//! 3. A [`ScanChart`] is the map once learning is over: the [ground](GroundPlan), two bits a cell,
//!    the places and the links. A file holds its [parts](ChartParts).
//! 4. A [`CorridorMap`] has the places where corridors meet or end, and the ways between them.
//! 5. [`Standpoints`] are a lattice of positions on it, with the view from each.
//! 6. A [`StandpointBelief`] is the belief of a robot, put down anywhere, about its position.
//!
//! The frame's axes are the compass's. Positions are in metres from the point where the robot was
//! first observed.

mod belief;
mod branches;
mod chart;
mod clearings;
mod config;
mod corridor_map;
mod evidence;
mod fit;
mod grid_area;
mod ground_plan;
mod map;
mod ranked_bits;
mod rays;
mod skeleton;
mod squares;
mod standpoints;
mod wall_grid;

pub use belief::StandpointBelief;
pub use chart::{ChartError, ChartParts, ScanChart};
pub use clearings::{Clearings, GroundWay};
pub use config::ScanMapConfig;
pub use corridor_map::{CorridorMap, CorridorPlace, CorridorWay};
pub use evidence::Explanation;
pub use ground_plan::{GroundKind, GroundPlan};
pub use map::{Advance, ScanMap, ScanPlace};
pub use standpoints::{StandpointViews, Standpoints};
pub use wall_grid::WallGrid;
