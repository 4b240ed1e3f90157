use pelage_graph::Param;

/// A choice.
#[derive(Clone, Param)]
pub enum Choice {
    /// One.
    One { far: bool },
}

fn main() {}
