//! Replays of runs in the arena.
//!
//! A [`Film`] records any outing: its path, its notes, its belief and its map as it grew. A
//! [`Glimpse`] is what it knows at one moment. A [`Recorder`] records one episode of a brain.
//! [`scenery_of`] is for replays of anything else on a course.
//!
//! # A mouse that learns
//!
//! `cargo run --example film_a_mouse`:
#![doc = "```"]
#![doc = include_str!("../examples/film_a_mouse.rs")]
#![doc = "```"]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

mod film;
mod growth;
mod recorder;
mod scenery;
mod swept_floor;

pub use film::{Film, Glimpse};
pub use recorder::Recorder;
pub use scenery::scenery_of;
