//! Grid mazes: cells, directions, one id per wall.
//!
//! A maze is a rectangle of square cells. Cell (0, 0) lies in the south-west corner, x grows to the
//! east and y to the north. Every edge between two cells, and every edge of the border, is one
//! [`Wall`]: both sides of it are the same wall, so two cells can never disagree.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

mod cell;
mod direction;
mod grid;
#[cfg(feature = "alloc")]
mod maze;

pub use cell::Cell;
pub use direction::Direction;
pub use grid::{Grid, Wall};
#[cfg(feature = "alloc")]
pub use maze::Maze;
