use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A place.
    #[param(default = [0.0; 3])]
    place: [f64; 3],
}

fn main() {}
