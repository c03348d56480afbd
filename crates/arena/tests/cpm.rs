//! CPM from outside: the paper's worked examples, and explorations of random mazes of corridors.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

extern crate alloc;

mod cpm {
    mod adversity;
    mod bad_input;
    mod explorations;
    mod files;
    mod localization;
    mod matching;
    mod pioneer;
    mod targets;
    mod trials;
    mod walks;
    mod wire;
    mod world;
}
