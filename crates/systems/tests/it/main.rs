//! Systems on robots that no simulator made.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod cpm;
mod own_robot;
