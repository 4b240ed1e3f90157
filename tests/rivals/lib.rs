//! Nothing but a benchmark: see `benches/mesh.rs`.
