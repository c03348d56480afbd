//! World steps per second.
fn main() {}
