//! The code of README and of the guides in `docs/`, compiled and run.

#[doc = include_str!("../../docs/own-robot.md")]
mod own_robot {}

#[doc = include_str!("../../docs/extend.md")]
mod extend {}

#[doc = include_str!("../../README.md")]
mod readme {}
