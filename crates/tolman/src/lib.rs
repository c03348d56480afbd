//! The application: it combines robots, systems, worlds and tables, and is the `tolman` command.
//!
//! A [`Catalogue`] lists what the command knows by name, and [`run`] is the command. To add a
//! [system](registry::SystemEntry), a robot or an experiment of your own, write a program that adds
//! it
//! to the
//! catalogue:
//!
//! ```no_run
//! use std::process::ExitCode;
//! use tolman::{Build, Catalogue};
//!
//! fn main() -> ExitCode {
//!     let catalogue = Catalogue::tolman().program("mine");
//!     tolman::run(&catalogue, &Build::current("unknown", "unknown"))
//! }
//! ```
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

mod catalogue;
mod cli;
mod replay_format;

pub use catalogue::Catalogue;
pub use cli::run;
pub use replay_format::ReplayFormat;
pub use tolman_arena::family::Family;
pub use tolman_arena::registry::{self, Start};
pub use tolman_experiment::Build;
