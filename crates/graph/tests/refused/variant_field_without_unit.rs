use pelage_graph::Param;

/// A choice.
#[derive(Clone, Param)]
pub enum Choice {
    /// One.
    One {
        /// How far.
        far: f64,
    },
}

fn main() {}
