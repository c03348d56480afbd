//! CPM from outside: the paper's worked examples, and explorations of random mazes.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

extern crate alloc;

mod cpm {
    mod bad_input;
    mod explorations;
    #[cfg(feature = "serde")]
    mod files;
    mod localization;
    mod matching;
    mod targets;
    mod turns;
    mod walks;
}
