//! Pictures of saved graphs with other switches, kept as goldens beside the graphs' own.

/// A saved graph with something set in it.
#[derive(Clone, Copy, Debug)]
pub struct Variant {
    /// What its golden is called.
    pub name: &'static str,
    /// The graph.
    pub graph: &'static str,
    /// What is set: inputs and their values.
    pub overrides: &'static [(&'static str, &'static str)],
}

/// Figure 4 of Lengyel et al. 2001 (its (d) is the graph's own picture), and each option of drawing that the graphs'
/// own pictures do not show.
pub const VARIANTS: &[Variant] = &[
    Variant { name: "figure4-a", graph: "figure4", overrides: &[("picture.shells", "false"), ("picture.fins", "false")] },
    Variant { name: "figure4-b", graph: "figure4", overrides: &[("picture.shells", "false")] },
    Variant { name: "figure4-c", graph: "figure4", overrides: &[("picture.fins", "false")] },
    Variant { name: "figure4-e", graph: "figure4", overrides: &[("picture.shells", "false"), ("picture.fins_on", "All")] },
    Variant { name: "figure4-f", graph: "figure4", overrides: &[("coat.lapped", "\"lapped.lapped\"")] },
    Variant { name: "figure4-g", graph: "figure4", overrides: &[("picture.detail", "Level(level: 1.0)")] },
    Variant { name: "figure4-h", graph: "figure4", overrides: &[("coat.length", "0.04")] },
    Variant { name: "figure4-i", graph: "figure4", overrides: &[("coat.slant", "45.0")] },
    Variant { name: "figure4-j", graph: "figure4", overrides: &[("picture.detail", "Level(level: 2.0)")] },
    Variant {
        name: "figure4-k",
        graph: "figure4",
        overrides: &[("coat.directions", "\"brushed.directions\""), ("coat.slants", "\"brushed.slants\"")],
    },
    Variant {
        name: "figure4-l",
        graph: "figure4",
        overrides: &[("coat.directions", "\"parted.directions\""), ("coat.slants", "\"parted.slants\"")],
    },
    Variant { name: "levels-blended", graph: "figure4", overrides: &[("picture.detail", "Level(level: 1.75)")] },
    Variant { name: "levels-skin", graph: "figure4", overrides: &[("picture.detail", "Level(level: 4.0)")] },
    Variant { name: "shadows-off", graph: "shadows", overrides: &[("picture.shadows", "false")] },
    Variant { name: "hair-shadow-off", graph: "shadows", overrides: &[("picture.hair_shadow", "0.0")] },
    Variant { name: "direction-map-off", graph: "shadows", overrides: &[("picture.direction_map", "false")] },
    Variant { name: "by-vertex", graph: "shadows", overrides: &[("picture.lighting", "Vertices")] },
    Variant { name: "by-table", graph: "shadows", overrides: &[("picture.lighting", "Table(size: 16)")] },
    Variant { name: "step-blur-off", graph: "ball", overrides: &[("shells.layers", "8"), ("picture.step_blur", "0.0")] },
    Variant { name: "anisotropic", graph: "meadow", overrides: &[("picture.anisotropy", "4"), ("picture.samples", "1")] },
    Variant { name: "depth-tested", graph: "shorn", overrides: &[("picture.depth", "Tested")] },
    Variant { name: "march-accurate", graph: "marched", overrides: &[("picture.march", "1"), ("picture.march_steps", "4")] },
    Variant { name: "coverage", graph: "shorn", overrides: &[("picture.depth", "Coverage")] },
    Variant { name: "by-patch", graph: "blocks", overrides: &[("picture.lighting", "Patches")] },
    Variant { name: "fin-from-a-file", graph: "drawn", overrides: &[("picture.shells", "false")] },
];
