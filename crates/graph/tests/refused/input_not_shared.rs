use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A number.
    #[input]
    number: f64,
}

fn main() {}
