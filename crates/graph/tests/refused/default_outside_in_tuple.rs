use pelage_graph::Node;

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.")]
pub struct Made {
    /// A size.
    #[param(default = (0, 720), range = 1..=16384, unit = "pixels")]
    size: (u32, u32),
}

fn main() {}
