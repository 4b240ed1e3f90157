//! What the tests of saved graphs share: evaluating a graph, and comparing its picture with the one kept of it.
//!
//! Run `cargo run --release -p pelage-tests --example goldens` to draw the kept pictures anew, and look at them before they are committed.

mod golden;
mod models;
mod scene;
mod variants;

pub use golden::{Bounds, Comparison, Golden};
pub use models::clean_models;
pub use scene::{Scene, gpu, graph_names, repository};
pub use variants::{VARIANTS, Variant};

/// Any error of a test's own machinery.
pub type Error = Box<dyn std::error::Error + Send + Sync>;
