use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A number.
    #[param(default = 2.5, range = 0.0..=2.0, unit = "metres")]
    number: f64,
}

fn main() {}
