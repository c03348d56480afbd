//! CPM's map from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod cpm {
    mod turns;
}
