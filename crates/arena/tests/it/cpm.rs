//! CPM from outside: the paper's worked examples, and explorations of random mazes of corridors.

mod adversity;
mod bad_input;
mod distinct;
mod episodes;
mod explorations;
mod files;
mod localization;
mod matching;
mod pioneer;
mod robots;
mod targets;
mod trials;
mod walkers;
mod walks;
mod wire;
mod world;
