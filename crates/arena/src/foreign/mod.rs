//! Runs foreign programs under supervision, such as a mouse or a brain in another language.
//!
//! A [`ForeignBrain`] drives a robot, in JSON lines, and a [`ForeignMapper`] watches one; a
//! [`ForeignEntry`] makes either a contestant of the arena. A [`Service`] lets a system drive a
//! robot that is another process. A [`ForeignProgram`] exchanges lines, within a [`Budget`] of
//! time, bytes and lines. When it is dropped, the program and all processes that it started are
//! killed, whatever group or session they moved to.
//!
//! On Linux that holds even if this process is killed. A process of its own, the keeper, stands
//! between it and the program. The keeper notices its end, and inherits what the program leaves
//! behind. The keeper is the same executable, which then calls [`keep`]; see [`Launch::keeper`]. On
//! other systems, and without a keeper, only the program itself is killed.
//!
//! ```no_run
//! use core::sync::atomic::AtomicBool;
//! use std::sync::Arc;
//!
//! use tolman_arena::foreign::{Budget, ForeignProgram, Launch, Log};
//!
//! let stop = Arc::new(AtomicBool::new(false));
//! let words = ["python3".to_owned(), "brain.py".to_owned()];
//! let launch = Launch { words: &words, keeper: &[], log: Log::Dropped, stop: &stop };
//! let mut brain = ForeignProgram::start(&launch, Budget::default())?;
//! brain.say("hello".to_owned())?;
//! let answer = brain.hear()?;
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod brain;
mod entry;
#[cfg(target_os = "linux")]
mod keeper;
mod mapper;
mod program;
mod service;
mod talk;
mod told;
mod wire;

pub use brain::{BrainError, Foreign, ForeignBrain, Hello, Itself};
pub use entry::{ForeignEntry, Role};
#[cfg(target_os = "linux")]
pub use keeper::keep;
pub use mapper::ForeignMapper;
pub use program::{Budget, ForeignProgram, Launch, LaunchError, Left, Log, Overrun};
pub use service::{Service, ServiceError};
pub use told::Told;
pub use wire::{NamedTask, WireError};
