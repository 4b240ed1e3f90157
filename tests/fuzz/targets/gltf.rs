//! See `pelage_fuzz::gltf`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelage_fuzz::gltf(bytes));
