//! Replays of runs in the arena.
//!
//! A [`Film`] watches any outing: its way, its thoughts, its belief, and how its map grew. A
//! [`Glimpse`] is what it knows at one moment. A [`Recorder`] watches one episode of a brain.
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
mod recorder;

pub use film::{Film, Glimpse};
pub use recorder::Recorder;
