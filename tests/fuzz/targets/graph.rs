//! See `pelage_fuzz::graph`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelage_fuzz::graph(bytes));
