//! A coat with its hair laid, ready for rays.

use glam::DVec3;
use pelage_coat::Coat;
use pelage_strand::StrandTile;

use crate::face::Skin;
use crate::lay::{Edges, lay};
use crate::segment::Origin;
use crate::tree::Tree;
use crate::{Laying, ReferenceError};

/// The real strands on the surface, in a hierarchy. Borrows the coat and the tile that it was made of.
pub struct Scene<'a> {
    pub(crate) skin: Skin<'a>,
    pub(crate) tile: &'a StrandTile,
    pub(crate) laying: Laying,
    pub(crate) tree: Tree,
    pub(crate) origins: Vec<Origin>,
    /// Whether some hair is there in part only, or lets light through.
    pub(crate) is_thin: bool,
    dropped: usize,
}

/// How much there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Straight tapered segments of hair.
    pub segments: usize,
    /// Triangles of skin.
    pub triangles: usize,
    /// Segments left out since they would end further than 10⁶ diameters away: free hair on needle-thin faces.
    pub dropped: usize,
    /// Bytes of segments, where they come from, triangles and boxes.
    pub bytes: usize,
}

impl std::fmt::Debug for Scene<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scene").field("counts", &self.counts()).field("laying", &self.laying).finish_non_exhaustive()
    }
}

impl<'a> Scene<'a> {
    /// Lays a tile of hair on a coat: the tile that the coat's textures were sampled from, or the two are not of the same fur.
    ///
    /// The same segments in the same order for any number of threads. 80 bytes a segment, and boxes of up to 68 more.
    ///
    /// # Errors
    /// A coat whose arrays do not agree or whose skin is far off, a box of hair without height, settings out of range, more hair than memory.
    pub fn new(coat: &'a Coat, tile: &'a StrandTile, laying: &Laying) -> Result<Self, ReferenceError> {
        let laid = lay(coat, tile, laying, Edges::Bodies)?;
        let skin = Skin { coat, length_scale: laying.length_scale };
        let places = |face: usize| skin.vertices(face).map(|v| coat.surface.positions[v].as_dvec3());
        let triangles: Vec<[DVec3; 3]> = (0..coat.patches.faces.len()).map(places).collect();
        let tree = Tree::new(laid.segments, triangles);
        let is_thin = !tile.is_opaque() || (0..coat.surface.offsets.len()).any(|v| skin.growth_at(v) < 1.0);
        Ok(Self { skin, tile, laying: *laying, tree, origins: laid.origins, is_thin, dropped: laid.dropped })
    }

    /// How much there is.
    pub fn counts(&self) -> Counts {
        Counts {
            segments: self.tree.segments.len(),
            triangles: self.tree.triangles.len(),
            dropped: self.dropped,
            bytes: self.tree.byte_size() + size_of_val(&self.origins[..]),
        }
    }
}
