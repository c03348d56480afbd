//! Scenarios that need several crates at once, by their public API. Mazes become courses, and
//! brains drive robots through them. The result is physically possible and always the same.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a scenario that cannot be set up has failed"
)]

extern crate alloc;

mod fuzz;
mod golden;
mod judges;
mod maze_page;
mod mazes;
mod mslst;
mod office_moves;
mod one_maze;
mod physics;
mod replay;
mod report;
mod support;
mod verdicts;
mod yardsticks;
