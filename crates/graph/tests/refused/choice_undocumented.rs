use pelage_graph::Param;

#[derive(Clone, Param)]
pub enum Choice {
    /// One.
    One,
}

fn main() {}
