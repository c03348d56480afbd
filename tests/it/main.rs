//! Scenarios that need several crates at once, seen from outside: mazes become courses, brains drive
//! robots through them, and what comes of it is physically possible and always the same.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a scenario that cannot be set up has failed"
)]

extern crate alloc;

mod golden;
mod mazes;
mod mslst;
mod physics;
mod replay;
mod report;
mod support;
mod yardsticks;
