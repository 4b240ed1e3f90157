use pelage_graph::Param;

/// A choice.
#[derive(Clone, Param)]
pub enum Choice {
    One,
}

fn main() {}
