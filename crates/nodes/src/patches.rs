//! Patches.

use std::sync::Arc;

use pelage_field::DirectionField;
use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_mesh::Mesh;
use pelage_patch::{LappedPatches, PatchTiling, Settings};

/// Grows lapped patches until every face belongs to exactly one (L3, L4, L5).
#[derive(Node)]
#[node(category = "Patches", version = 2)]
#[output(patches: PatchTiling, "The tiling.")]
pub struct GrowPatches {
    /// Surface to cover.
    #[input]
    pub mesh: Arc<Mesh>,
    /// Directions to align with; without it the tiling is isotropic (L5).
    #[input]
    pub directions: Option<Arc<DirectionField>>,
    /// Side of the hair tile on the surface.
    #[param(default = 0.08, range = 0.001..=10.0, unit = "model diameters", effect = "smaller: finer hair, more repeats of the tile")]
    pub tile_size: f64,
    /// How far a patch reaches at most; past 1 the tile repeats within it.
    #[param(default = 0.9, range = 0.05..=100.0, unit = "tile sides", effect = "larger: fewer seams, until stretch and turning end the growth")]
    pub patch_extent: f64,
    /// How much following the field counts against even density.
    #[param(default = 0.5, range = 0.0..=1000000.0, unit = "weight", effect = "larger: truer directions; hair thins and crowds where the field spreads and bends")]
    pub alignment: f64,
    /// How far a face's map may stretch or shrink it, against the wanted scale.
    #[param(default = 2.0, range = 1.05..=10.0, unit = "ratio", effect = "smaller: hair of more even density, smaller patches")]
    pub max_stretch: f64,
    /// How far the fur of a face may turn from the field.
    #[param(default = 60.0, range = 1.0..=90.0, unit = "degrees", effect = "smaller: truer directions, smaller patches")]
    pub max_turning: f64,
    /// Where patches start, their outlines, and which part of the tile they show.
    #[param(default = 1, unit = "seed", effect = "another tiling of the same quality")]
    pub seed: u64,
}

impl Evaluate for GrowPatches {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = Settings {
            tile_side: self.tile_size * self.mesh.diameter(),
            patch_extent: self.patch_extent,
            alignment: self.alignment,
            max_stretch: self.max_stretch,
            max_turning: self.max_turning.to_radians(),
            seed: self.seed,
        };
        Ok(pelage_patch::grow(&self.mesh, self.directions.as_deref(), &settings)?.into())
    }
}

/// Patches that overlap, each with the outline of its splotch, towards which it fades (L6): how lapped textures are pasted, for comparison. No seams, but more triangles, and hair twice as
/// dense where patches overlap.
#[derive(Node)]
#[node(category = "Patches", version = 1)]
#[output(lapped: LappedPatches, "The patches.")]
pub struct LapPatches {
    /// Surface to cover.
    #[input]
    pub mesh: Arc<Mesh>,
    /// Directions to align with; without it each patch is turned at random.
    #[input]
    pub directions: Option<Arc<DirectionField>>,
    /// Side of the hair tile on the surface.
    #[param(default = 0.08, range = 0.001..=10.0, unit = "model diameters", effect = "smaller: finer hair, more repeats of the tile")]
    pub tile_size: f64,
    /// Diameter of a patch.
    #[param(default = 0.9, range = 0.05..=100.0, unit = "tile sides", effect = "larger: fewer patches, until stretch and turning end the growth")]
    pub patch_extent: f64,
    /// How much following the field counts against even density.
    #[param(default = 0.5, range = 0.0..=1000000.0, unit = "weight", effect = "larger: truer directions; hair thins and crowds where the field spreads and bends")]
    pub alignment: f64,
    /// How far a face's map may stretch or shrink it, against the wanted scale.
    #[param(default = 2.0, range = 1.05..=10.0, unit = "ratio", effect = "smaller: hair of more even density, smaller patches")]
    pub max_stretch: f64,
    /// How far the fur of a face may turn from the field.
    #[param(default = 60.0, range = 1.0..=90.0, unit = "degrees", effect = "smaller: truer directions, smaller patches")]
    pub max_turning: f64,
    /// Where patches are, their outlines, and which part of the tile they show.
    #[param(default = 1, unit = "seed", effect = "other patches of the same quality")]
    pub seed: u64,
}

impl Evaluate for LapPatches {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let settings = Settings {
            tile_side: self.tile_size * self.mesh.diameter(),
            patch_extent: self.patch_extent,
            alignment: self.alignment,
            max_stretch: self.max_stretch,
            max_turning: self.max_turning.to_radians(),
            seed: self.seed,
        };
        Ok(pelage_patch::lap(&self.mesh, self.directions.as_deref(), &settings)?.into())
    }
}
