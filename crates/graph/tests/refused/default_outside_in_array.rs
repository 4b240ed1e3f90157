use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A place.
    #[param(default = [0.0, -3.0], range = -1.0..=1.0, unit = "metres")]
    place: [f64; 2],
}

fn main() {}
