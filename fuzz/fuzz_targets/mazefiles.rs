#![no_main]

use libfuzzer_sys::fuzz_target;
use tolman_fuzz::parses_or_refuses;
use tolman_maze::Format;

fuzz_target!(|text: &str| parses_or_refuses(text, Format::Mazefiles));
