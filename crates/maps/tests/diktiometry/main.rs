//! The diktiometry on worlds of places, whose truth is known.
#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot set itself up has failed"
)]

extern crate alloc;

mod certificates;
#[cfg(feature = "serde")]
mod files;
mod learning;
mod properties;
mod put_down;
mod walk;
