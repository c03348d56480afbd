//! Tests of the runner with an experiment that knows no maze: players throw darts at a board.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

extern crate alloc;

mod chunks;
mod darts;
mod folder;
mod results;
mod support;
