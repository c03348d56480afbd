#![no_main]

use libfuzzer_sys::fuzz_target;
use tolman_fuzz::is_used_or_left_out;

fuzz_target!(|bytes: &[u8]| is_used_or_left_out(bytes));
