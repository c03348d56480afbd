//! The code of README and of the guides in `docs/`, compiled and run; and what all readers of files
//! must hold to, whatever the file, for [fuzzing](fuzz).

pub mod fuzz;

#[doc = include_str!("../../docs/own-robot.md")]
mod own_robot {}

#[doc = include_str!("../../docs/extend.md")]
mod extend {}

#[doc = include_str!("../../README.md")]
mod readme {}
