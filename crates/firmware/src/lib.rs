//! The program of a classic micromouse, without its hardware: an example of how wall map, planners
//! and exploration go together on a chip. No standard library, no allocation, no panic; everything
//! a [`Mouse`] holds fits into 10 KiB.
//!
//! The firmware's main loop drives one cell, reads the three wall sensors and asks for the next
//! [`Command`]. When it notices a crash, it reports it. A mouse that was moved unnoticed sees walls
//! that contradict its map. It then looks for its place, or asks to be carried back and begins
//! a new map. The fast run comes out as moves.
//!
//! ```
//! use tolman_firmware::{Command, Mouse, Sides};
//! use tolman_maze::{Cell, Direction};
//! use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};
//!
//! let times = SpeedRunTimes::new(&SpeedRunConfig::classic())?;
//! let goals = [Cell::new(7, 7), Cell::new(7, 8), Cell::new(8, 7), Cell::new(8, 8)];
//! let mut mouse = Mouse::new(&times, &goals);
//! // In the start, open ahead only:
//! let command = mouse.arrive(Sides { left: false, ahead: true, right: false })?;
//! assert_eq!(command, Command::Drive(Direction::North));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # The main loop
//!
//! `cargo run --example search`:
#![doc = "```"]
#![doc = include_str!("../examples/search.rs")]
#![doc = "```"]
#![no_std]

mod mouse;

pub use mouse::{Command, MAZE, Mouse, Sides};
