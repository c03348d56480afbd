#![no_main]

use libfuzzer_sys::fuzz_target;
use tolman_fuzz::detects_or_refuses;

fuzz_target!(|text: &str| detects_or_refuses(text));
