//! Tests the whole crate at once.

mod golden;
mod properties;
