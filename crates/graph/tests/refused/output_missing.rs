use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
pub struct Made {
    /// A number.
    #[param(default = 1.0, range = 0.0..=2.0, unit = "metres")]
    number: f64,
}

fn main() {}
