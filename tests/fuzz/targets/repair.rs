//! See `pelage_fuzz::repair`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelage_fuzz::repair(bytes));
