use pelage_graph::Param;

/// A choice.
#[derive(Clone, Param)]
pub enum Choice {
    /// One.
    One(bool),
}

fn main() {}
