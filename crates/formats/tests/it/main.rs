//! The formats seen from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod data_sets;
mod graph;
mod logs;
mod rosbag;
