//! Beliefs about the walls of a grid maze and the mouse's pose, for a mouse whose sensors and
//! wheels err.
//!
//! Section 6 of "Plot and Navigate a Virtual Maze" (Wang) names what a real mouse needs beyond the
//! paper's. That is thick walls, a probabilistic model of motion and sensors, a particle filter,
//! and a map that grows with it. Here a [`WallBelief`] weighs the evidence for and against every
//! wall, and implements [`Walls`](tolman_maze::Walls) for the planners. A [`PoseFilter`] estimates
//! the mouse's pose among the walls believed so far.
//!
//! The paper gives only the idea. Models and numbers are ours, after Thrun, Burgard and Fox,
//! "Probabilistic robotics" (2005), chapters 6 and 8.
//!
//! Metres and radians; the origin is the south-western corner of the maze.

mod filter;
mod range_model;
mod walls;

pub use filter::{PoseFilter, PoseFilterConfig};
pub use range_model::RangeModel;
pub use walls::{Meeting, RangeReading, WallBelief};
