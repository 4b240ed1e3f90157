//! See `pelage_fuzz::obj`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelage_fuzz::obj(bytes));
