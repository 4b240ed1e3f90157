//! A coat: what there is to draw, once for all who draw it.
//!
//! Plain arrays and no crate of ours: the surface, how the hair tile lies on it, how far and which way the fur stands,
//! its colour, and the textures sampled from its strands. `pelage-render` draws it; whoever builds it need not know how.
//!
//! # Convention
//! Coordinates are the model's, moved and scaled so that the box around it is centred at the origin and its diagonal, the *diameter*,
//! is 1 ([`Frame`]). Right-handed, y up. Faces wind anticlockwise seen from outside. Colours are linear light, Rec. 709 primaries.
//!
//! # Example
//! One bare triangle, checked before it is drawn:
//! ```
//! use std::sync::Arc;
//!
//! use glam::{DVec3, Vec2, Vec3};
//! use pelage_coat::{Coat, CoatError, FinEdges, Frame, MipImage, PatchMesh, ShellTexture, Surface};
//!
//! let surface = Surface {
//!     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
//!     normals: vec![Vec3::Z; 3],
//!     offsets: vec![Vec3::ZERO; 3],
//!     bends: vec![Vec3::ZERO; 3],
//!     ends: vec![1.0; 3],
//!     mixes: vec![0.0; 3],
//!     directions: vec![Vec3::Z; 3],
//!     colours: vec![Vec3::ONE; 3],
//! };
//! let patches = PatchMesh {
//!     vertices: vec![0, 1, 2],
//!     coordinates: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
//!     faces: vec![[0, 1, 2]],
//!     patch_ends: vec![1],
//!     opacities: Vec::new(),
//! };
//! let skin = MipImage { width: 1, height: 1, texels: vec![180, 140, 120, 255] };
//! let mut coat = Coat {
//!     frame: Frame { centre: DVec3::ZERO, diameter: 1.0 },
//!     surface,
//!     patches,
//!     edges: FinEdges::default(),
//!     shells: Arc::new(ShellTexture::stack(1, vec![skin])),
//!     fin: None,
//! };
//! assert_eq!(coat.check(), Ok(()));
//!
//! coat.patches.faces[0][2] = 7;
//! assert_eq!(coat.check(), Err(CoatError::Index { array: "patches.faces", at: 2, index: 7, count: 3 }));
//! ```
//!
//! # Sources
//! The arrays are what Lengyel, Praun, Finkelstein and Hoppe 2001 (*Real-time fur over arbitrary surfaces*) draw from: per vertex a colour and
//! an offset *c_v* (section 3), lapped patches of one toroidal stack (2.1), a fin texture and its edges (2.2).

mod camera;
mod check;
mod light;
mod mixtures;
mod texture;

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};

pub use camera::{Background, Camera};
pub use check::CoatError;
pub use light::{Irradiance, Light, Lights};
pub use texture::{Encoding, FinTexture, MipImage, ShellLayer, ShellTexture};

/// Where coat coordinates lie in the model's own: model = centre + diameter × coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The centre of the model's bounding box, in model units.
    pub centre: DVec3,
    /// The diagonal of the model's bounding box, in model units; positive.
    pub diameter: f64,
}

impl Frame {
    /// A place in model coordinates as one in coat coordinates; rounded only after it is normalised.
    pub fn place(&self, model: DVec3) -> Vec3 {
        ((model - self.centre) / self.diameter).as_vec3()
    }
}

/// The skin: per-vertex arrays of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Where each vertex is.
    pub positions: Vec<Vec3>,
    /// Unit outward normals; zero for an unreferenced vertex.
    pub normals: Vec<Vec3>,
    /// *c_v*: from the skin to the outermost shell; its length is the fur's, its tangential part the slant (L19, L20). Zero: bare.
    pub offsets: Vec<Vec3>,
    /// How the hair bends on its way: at height *h* it stands at *c_v* *h* + *b* (*h*² − *h*), so that it leaves the skin along *c_v* − *b* and ends along
    /// *c_v* + *b* (K11). Zero: straight.
    pub bends: Vec<Vec3>,
    /// Where along *c_v* the hair is cut off, 0 to 1: above it there is none. 1: whole.
    pub ends: Vec<f32>,
    /// Between which of the textures' mixtures of hair the hair is, from the first at 0 to the last at 1 (L24); beyond, as at the nearer end.
    pub mixes: Vec<f32>,
    /// *T*: the mean of the hair's unit directions, for lighting, stored apart from the offset (L14). At most 1 long; the shorter, the more the hair differs.
    pub directions: Vec<Vec3>,
    /// A colour that multiplies the textures' (L18), 0 to 1.
    pub colours: Vec<Vec3>,
}

/// How the hair tile lies on the surface: each patch has its own vertices, so that tile coordinates jump only between patches.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PatchMesh {
    /// The surface vertex under each patch vertex.
    pub vertices: Vec<u32>,
    /// Tile coordinates of each patch vertex; one unit is one repeat of the toroidal tile.
    pub coordinates: Vec<Vec2>,
    /// Corners of each face as patch vertices, faces of one patch in a row.
    pub faces: Vec<[u32; 3]>,
    /// Where the faces of each patch end in `faces`.
    pub patch_ends: Vec<u32>,
    /// How opaque the hair of each patch vertex is, 0 to 1, where patches overlap and fade towards their outlines (L6); empty: all is whole, as it is where they do not.
    pub opacities: Vec<f32>,
}

/// The edges that fins can stand on: arrays of equal length, one entry an edge (L9, L11).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FinEdges {
    /// The edge's surface vertices.
    pub vertices: Vec<[u32; 2]>,
    /// The horizontal interval of the fin texture at the two ends: it starts at random, and its length is the edge's in tile coordinates
    /// over the tiles that the fin texture spans. Signed, wrapped.
    pub intervals: Vec<[f32; 2]>,
    /// The unit normals of the two faces; at a boundary the second is zero.
    pub face_normals: Vec<[Vec3; 2]>,
    /// How fast the surface turns across the edge: the angle between the face normals over the distance between the face centres, in radians per diameter.
    pub curvatures: Vec<f32>,
}

/// A coat of fur on a surface, ready to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Coat {
    /// Where it lies in the model's coordinates.
    pub frame: Frame,
    /// The skin.
    pub surface: Surface,
    /// The tiling.
    pub patches: PatchMesh,
    /// The edges; none where there is no fin.
    pub edges: FinEdges,
    /// The shell layers; [`ShellTexture::bare`] where there are none, and with the innermost alone no shells are drawn.
    pub shells: Arc<ShellTexture>,
    /// The fin texture; without one no fins are drawn.
    pub fin: Option<Arc<FinTexture>>,
}

impl Coat {
    /// The least and greatest corner of the box around skin and fur; two zeros where there is no patch. Indices past the end are passed over.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut bounds = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &vertex in &self.patches.vertices {
            let (skin, offset) = (self.surface.positions.get(vertex as usize), self.surface.offsets.get(vertex as usize));
            let (Some(&skin), Some(&offset)) = (skin, offset) else { continue };
            // The curve's control points hold it between them; a missing bend is none.
            let bend = self.surface.bends.get(vertex as usize).copied().unwrap_or_default();
            for p in [skin, skin + 0.5 * (offset - bend), skin + offset] {
                bounds = (bounds.0.min(p), bounds.1.max(p));
            }
        }
        if bounds.0.x <= bounds.1.x { bounds } else { (Vec3::ZERO, Vec3::ZERO) }
    }

    /// How many bytes it holds, textures not counted twice where they are shared.
    pub fn byte_size(&self) -> usize {
        self.surface.positions.len() * (6 * size_of::<Vec3>() + 2 * size_of::<f32>())
            + self.patches.vertices.len() * 12
            + self.patches.opacities.len() * 4
            + self.patches.faces.len() * 12
            + self.edges.vertices.len() * (8 + 8 + 24 + 4)
    }
}
