//! The formats seen from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[cfg(feature = "mcap")]
extern crate alloc;

mod data_sets;
mod graph;
mod logs;
#[cfg(feature = "mcap")]
mod rosbag;
