//! The application: it composes robots, systems, worlds and tables, and is the `tolman` command.
//!
//! [`catalogue`] is what it knows by name.

pub use tolman_papers::catalogue;
