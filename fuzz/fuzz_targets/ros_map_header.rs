#![no_main]

use libfuzzer_sys::fuzz_target;
use tolman_fuzz::is_a_header_or_refused;

fuzz_target!(|text: &str| is_a_header_or_refused(text));
