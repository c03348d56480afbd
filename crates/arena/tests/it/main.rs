//! The arena seen from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

extern crate alloc;

mod better_map;
mod cpm;
mod gngslam;
mod online_slam;
mod place_scores;
