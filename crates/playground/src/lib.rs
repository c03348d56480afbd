//! A page on which robots learn a maze that the reader draws.
//!
//! In the order data flows: a [`Sketch`] is the maze under the reader's hand. A [`Playground`]
//! sends a system into it. A [`Session`] lets the system act a few time steps at a time, puts its
//! robot elsewhere, and sends it to the goal. It reports the outcome. What it shows is a replay
//! that grows, for the same player as every other run.
//!
//! The [`lessons`] have tasks for pupils, and mark what they answer.
//!
//! Compiled for `wasm32-unknown-unknown`, the module `bindings` hands these to JavaScript;
//! `cargo xtask playground` puts them into one HTML file with the page below `page`.

extern crate alloc;

#[cfg(target_arch = "wasm32")]
mod bindings;
pub mod lessons;
mod playground;
mod session;
mod sketch;
mod verdict;

pub use playground::{Playground, PlaygroundError, SystemChoice};
pub use session::{Session, SessionState, SessionTask};
pub use sketch::{Sketch, SketchPlan, SketchWall};
pub use verdict::{TaskVerdict, Tone};
