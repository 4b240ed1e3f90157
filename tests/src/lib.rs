//! What the tests of saved graphs share: evaluating a graph, comparing its picture with the one kept of it, and measuring frames side by side.
//!
//! Run `cargo run --release -p pelage-tests --example goldens` to draw the kept pictures anew, and look at them before they are committed.

mod golden;
mod measured;
mod models;
mod race;
mod scene;
mod stage;
mod variants;

pub use golden::{Bounds, Comparison, Golden};
pub use measured::{Figures, Page, Row, number, span};
pub use models::clean_models;
pub use race::{Contender, Finish, Fur, race};
pub use scene::{Scene, gpu, graph_names, repository};
pub use stage::{SIZE, Stage};
pub use variants::{VARIANTS, Variant};

/// Any error of a test's own machinery.
pub type Error = Box<dyn std::error::Error + Send + Sync>;
