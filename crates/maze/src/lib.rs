//! Grid mazes: cells, directions, one id per wall; their text formats; generators.
//!
//! A maze is a rectangle of square cells. [`Cell`] (0, 0) lies in the south-west corner, x grows to
//! the east and y to the north. Every edge between two cells, and every edge of the border, is one
//! [`Wall`]. Both sides of it are the same wall, so two cells can never disagree.
//!
//! A maze comes from a file: [`read`] takes the text of any [`Format`] and detects which one it is.
//! It returns a [`MazeFile`] whose maze can be solved, or a [`MazeError`] that names line, column,
//! the offending value and the repair.
//!
#![cfg_attr(feature = "alloc", doc = "```")]
#![cfg_attr(not(feature = "alloc"), doc = "```ignore")]
//! let text = "\
//! name = Hook
//! corridor_width = 0.5
//!
//! +---+---+---+
//! |           |
//! +   +---+   +
//! | S |     G |
//! +---+---+---+
//! ";
//! let file = tolman_maze::read(text)?;
//! let (start, heading) = file.maze.start().unwrap();
//! assert_eq!(heading, tolman_maze::Direction::North);
//! let steps = file.maze.steps_to_goal();
//! assert_eq!(steps[file.maze.grid().index(start)], Some(4));
//! # Ok::<(), tolman_maze::MazeError>(())
//! ```
//!
//! Or it comes from a generator, with the caller's random numbers:
//!
#![cfg_attr(feature = "alloc", doc = "```")]
#![cfg_attr(not(feature = "alloc"), doc = "```ignore")]
//! use rand::SeedableRng;
//! use tolman_maze::Perfect;
//!
//! let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
//! let maze = Perfect { width: 16, height: 16 }.generate(&mut rng)?;
//! assert_eq!(maze.opening_count(), 16 * 16 - 1);
//! # Ok::<(), tolman_maze::GenerateError>(())
//! ```
//!
//! The [`Maze`] then answers what a world, a planner or a mouse asks: [`Maze::is_open`],
//! [`Maze::neighbours`], [`Maze::steps_to_goal`]; it displays as a drawing; and [`write()`] turns it
//! into the text of any format that can hold it.
//!
//! What a robot has learned of a maze so far is any type that is [`Walls`]: of each wall it has some
//! [`Knowledge`]. Planners and searches ask no more of a map than that.
//!
//! Without the feature `alloc` only cells, directions, the numbering of walls and the vocabulary of partial
//! knowledge are left: what firmware builds its own map on.
//!
//! # A file checked and converted
//!
//! `cargo run --example convert`:
#![cfg_attr(feature = "alloc", doc = "```")]
#![cfg_attr(not(feature = "alloc"), doc = "```ignore")]
#![doc = include_str!("../examples/convert.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
#[cfg(feature = "alloc")]
pub use rand;

mod cell;
#[cfg(feature = "alloc")]
mod check_error;
mod direction;
#[cfg(feature = "alloc")]
mod formats;
#[cfg(feature = "alloc")]
mod generators;
mod grid;
mod knowledge;
#[cfg(feature = "alloc")]
mod maze;
#[cfg(feature = "alloc")]
mod motion;

pub use cell::Cell;
pub use direction::Direction;
pub use grid::{Grid, Wall};
pub use knowledge::{Knowledge, Walls};
#[cfg(feature = "alloc")]
pub use {
    check_error::CheckError,
    formats::{
        Format, MazeError, MazeFault, MazeFile, UnknownFormat, WriteError, maz_text, parse,
        parse_as, read, read_as, write,
    },
    generators::{Braided, GenerateError, Hook, OneLoop, Perfect, Rooms, drawings},
    maze::Maze,
};
