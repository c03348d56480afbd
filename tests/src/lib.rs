//! The code of the guides in `docs/`, compiled and run.

#[doc = include_str!("../../docs/own-robot.md")]
mod own_robot {}
