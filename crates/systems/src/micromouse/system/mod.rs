//! A micromouse that drives a robot with a laser ring, a compass and encoders through a grid maze,
//! cell by cell.
//!
//! A [`MazeMouse`] is a [`Mapper`](tolman_robot::Mapper) of cells and a
//! [`System`](tolman_robot::System) for every robot that turns and translates. It knows the size of
//! the maze, its start, its goals and its pitch. Exploration ends when its
//! [`Search`](super::Search) has its proof, or has been everywhere. Put down anywhere, it localizes
//! by the walls.
//!
//! Metres and radians; the origin is the south-western corner of the maze, and the compass reads 0
//! in the east.

mod choice;
mod config;
mod lost;
mod mapper;
mod maze_mouse;
mod pilot;
mod sight;
#[cfg(test)]
mod tests;
mod whereabouts;

pub use config::{MazeMouseConfig, MazeMouseError};
pub use maze_mouse::MazeMouse;
pub use sight::CellSight;
