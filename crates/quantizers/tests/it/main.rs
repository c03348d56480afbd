//! The quantizers seen from outside.

#![expect(clippy::unwrap_used, reason = "a test may fail")]

extern crate alloc;

mod bad_input;
mod equilibrium;
mod gng;
mod no_allocation;
mod replay;
mod saving;
mod search;
mod soinn;
mod streams;
mod sweep;
