#![no_main]

use libfuzzer_sys::fuzz_target;
use tolman_fuzz::is_a_graph_or_refused;

fuzz_target!(|bytes: &[u8]| is_a_graph_or_refused(bytes));
