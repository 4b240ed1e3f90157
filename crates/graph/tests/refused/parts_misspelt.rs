use pelage_graph::Node;

const TOP: pelage_graph::Part = pelage_graph::Part { name: "top", doc: "The top." };

/// A node.
#[derive(Node)]
#[node(category = "Test")]
#[output(value: f64, "A number.", part = [TOP])]
struct Misspelt {}

fn main() {}
