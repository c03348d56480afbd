//! What a system sees of a robot.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod fitted;
