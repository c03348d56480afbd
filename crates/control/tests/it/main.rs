//! The layers seen from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod ends;
mod epuck;
#[cfg(feature = "serde")]
mod files;
mod layers;
