use pelage_graph::Param;

/// A choice.
#[derive(Clone, Param)]
pub enum Choice {
    /// One.
    One {
        /// How far.
        #[param(default = -1.0, range = 0.0..=1.0, unit = "metres")]
        far: f64,
    },
}

fn main() {}
