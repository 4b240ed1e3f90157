use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A number.
    #[param(default = 2, range = 0..2, unit = "metres")]
    number: u32,
}

fn main() {}
