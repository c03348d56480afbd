//! The systems: one paper a folder, written to be read beside it.
//!
//! Each system drives any robot that senses what it needs, simulated or real, through the traits of
//! `tolman-robot`. Nothing here knows a simulator, a terminal or the truth.

extern crate alloc;

pub mod baselines;
pub mod cpm;
pub mod diktiometry;
pub mod file_kind;
pub mod micromouse;
pub mod mslst;
