//! What any bytes whatever must not break.
//!
//! A target is a function here that takes bytes and asserts what must hold of them, with a program of three lines in `targets/` that hands it what the fuzzer thinks
//! of, and a folder of small inputs in `corpus/` to start from, which `cargo test` goes through as well. To add one: write all three, and name
//! it in `tests/corpus.rs`. What a fuzzer finds becomes a test with a name, in the crate at fault, and stays in the corpus.
//!
//! With `cargo install cargo-fuzz`, on a stable toolchain (from the root; new inputs go to the first folder):
//!
//! ```text
//! mkdir -p target/fuzz/obj
//! cargo fuzz run --fuzz-dir tests/fuzz --sanitizer none --features libfuzzer obj target/fuzz/obj tests/fuzz/corpus/obj -- -max_total_time=600
//! ```

mod graph;
mod mesh;

pub use graph::graph;
pub use mesh::{gltf, obj, repair};
