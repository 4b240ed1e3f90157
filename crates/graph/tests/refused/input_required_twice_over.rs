use std::sync::Arc;

use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
struct Redundant {
    /// It is required as it is.
    #[input(required)]
    number: Arc<f64>,
}

fn main() {}
