//! What a caller may choose, and what can be wrong with it.

use pelage_mesh::Mesh;

/// Side of the hair tile that suits most models, as a fraction of [`Mesh::diameter`].
pub const DEFAULT_TILE_FRACTION: f64 = 0.08;
/// Splotch diameter that suits most models, in tiles.
pub const DEFAULT_PATCH_EXTENT: f64 = 0.9;
/// The weight of alignment at which, on animals of 5,000 faces, hair strays 2° to 8° from the field on the mean and
/// is stretched by 1 % to 8 % on the median.
pub const DEFAULT_ALIGNMENT: f64 = 0.5;
/// Greatest stretch of any face.
pub const DEFAULT_MAX_STRETCH: f64 = 2.0;
/// Greatest turning of any face, in radians: 60°.
pub const DEFAULT_MAX_TURNING: f64 = std::f64::consts::FRAC_PI_3;

/// How patches are to be grown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Side of the hair tile on the surface, in model units; finite and above 0. Hair gets coarser with it; with
    /// `tile_side` × `patch_extent` kept, neither the patches nor the time change.
    pub tile_side: f64,
    /// Diameter of the splotch that a patch fills, in tiles; finite and above 0, and may exceed 1, as the tile repeats (Lengyel et al.
    /// 2001, section 2.1). Twice the extent: about a quarter of the patches, and more stretch and turning, up to the bounds below.
    pub patch_extent: f64,
    /// How much following the field counts against even density, 0 to 1e6. At 0 only the patch's middle is turned to the field; at 1e6 the
    /// field is followed as in the lapped textures paper, and hair thins out or crowds where the field spreads or bends. Has no meaning
    /// without a field.
    pub alignment: f64,
    /// Greatest stretch, against the wanted scale, of any face with area: both singular values of the map from surface to tile stay within
    /// [1/`max_stretch`, `max_stretch`]. Above 1. Lower: hair of more even density, smaller patches.
    pub max_stretch: f64,
    /// Greatest angle between field and hair on any face with area, in radians; above 0, at most π/2. Has no meaning without a field. Faces that would
    /// otherwise be tiny patches are let off it ([`PatchTiling::let_off`](crate::PatchTiling::let_off)).
    pub max_turning: f64,
    /// Chooses where patches start, their outlines, and which part of the tile they show.
    pub seed: u64,
}

impl Settings {
    /// The project's defaults around a tile of the given side, in model units.
    pub fn with_tile_side(tile_side: f64) -> Self {
        Self {
            tile_side,
            patch_extent: DEFAULT_PATCH_EXTENT,
            alignment: DEFAULT_ALIGNMENT,
            max_stretch: DEFAULT_MAX_STRETCH,
            max_turning: DEFAULT_MAX_TURNING,
            seed: 0,
        }
    }

    /// The project's defaults for a model: a tile [`DEFAULT_TILE_FRACTION`] of its diameter across (1 for a model without extent).
    pub fn for_mesh(mesh: &Mesh) -> Self {
        let side = DEFAULT_TILE_FRACTION * mesh.diameter();
        Self::with_tile_side(if side > 0.0 { side } else { 1.0 })
    }

    /// Checks each setting against its range.
    ///
    /// # Errors
    /// The first setting that is out of range.
    pub fn validate(&self) -> Result<(), PatchError> {
        check("tile_side", self.tile_side, "finite and above 0", |v| v > 0.0)?;
        check("patch_extent", self.patch_extent, "finite and above 0", |v| v > 0.0)?;
        check("alignment", self.alignment, "from 0 to 1e6", |v| (0.0..=1e6).contains(&v))?;
        check("max_stretch", self.max_stretch, "finite and above 1", |v| v > 1.0)?;
        check("max_turning", self.max_turning, "above 0 and at most π/2 radians", |v| v > 0.0 && v <= std::f64::consts::FRAC_PI_2)
    }
}

fn check(name: &'static str, value: f64, wanted: &'static str, holds: impl Fn(f64) -> bool) -> Result<(), PatchError> {
    if value.is_finite() && holds(value) { Ok(()) } else { Err(PatchError::Setting { name, value, wanted }) }
}

/// Why there is no tiling.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PatchError {
    /// A setting is out of its range.
    #[error("{name} is {value}; it must be {wanted}")]
    Setting {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Its range, in words.
        wanted: &'static str,
    },
    /// The field was made for another mesh.
    #[error("the direction field has {directions} vectors and the mesh {vertices} vertices; make the field from this mesh")]
    DirectionCount {
        /// Vectors of the field.
        directions: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// The model measured in tiles is no usable number.
    #[error(
        "the model's diameter is {diameter} and the tile's side {tile_side}: their ratio is beyond 1e±100; \
         choose tile_side nearer to the diameter"
    )]
    Scale {
        /// The model's diameter.
        diameter: f64,
        /// The side of the tile.
        tile_side: f64,
    },
    /// A patch number is wanted for each face.
    #[error("{given} patch numbers for {faces} faces; give one for each face")]
    FaceCount {
        /// Numbers given.
        given: usize,
        /// Faces of the mesh.
        faces: usize,
    },
    /// Patches are numbered without gaps.
    #[error("patch {patch} has no face, though patch {last} has; number the patches 0, 1, 2, … without gaps")]
    EmptyPatch {
        /// The number without a face.
        patch: u32,
        /// The greatest number in use.
        last: u32,
    },
    /// A vertex was placed nowhere.
    #[error("vertex {vertex} of patch {patch} is at {place}; give it a finite place")]
    NoPlace {
        /// The patch.
        patch: u32,
        /// The surface vertex.
        vertex: u32,
        /// Where it was placed.
        place: glam::DVec2,
    },
}
