//! From polygons to a surface.
//!
//! Every repair is a file here, takes what the one before it left, and is counted in [`RepairReport`]. Their order:
//!
//! 1. *Welding*, since whether two faces touch is asked of vertices ever after.
//! 2. *Cutting* polygons, and dropping what welding left fewer than three corners. A triangle is all that the rest knows.
//! 3. *Duplicates*, as the next step asks for the one face across an edge.
//! 4. *Faces without area*, before a pair is chosen at crowded edges: they have no direction to choose by, and crowd edges themselves.
//! 5. *Edges* with more than two faces, before windings: a winding spreads over an edge only between faces that belong together.
//! 6. *Windings*, and with them the *cut* of a surface with one side, before fans: that a fan is torn by a cut is seen only now.
//! 7. *Vertices*, one for each fan. Here taking apart and cutting come into effect.
//! 8. *Closed pieces* turned outwards, for what is closed and what is a piece is known only now.
//! 9. *Vertices without a face*, which all the others may have left.

mod colours;
mod duplicates;
mod error;
mod faces;
mod flat;
mod mates;
mod outward;
mod polygons;
mod report;
mod scale;
mod sets;
mod soup;
mod split;
mod weld;
mod winding;

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec4};

use crate::{FaceId, Mesh, Topology};

pub use error::RepairError;
pub use report::RepairReport;
pub use soup::Soup;

use faces::Faces;
use flat::Places;
use mates::Mates;
use scale::Scale;

/// How far apart vertices may be and still be welded, unless told otherwise, as a part of the model's diameter.
///
/// Eight steps of an `f32` coordinate, or one of the six digits that most programs print: copies of a vertex that were worked out in two ways, such as the
/// ends of a seam at angles 0 and 2π, are that far apart and no farther. The edges of a model of ten million faces are about 300 times as long.
pub const WELD_TOLERANCE: f64 = 1e-6;

/// Nor are vertices welded that are farther apart than this part of the median side of a polygon. The diameter alone would let one far-off face swallow a
/// model whole.
const MOST_OF_AN_EDGE: f64 = 1e-3;

/// How [`repair`] goes about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepairSettings {
    /// How far apart two vertices may be and still become one, as a part of the model's diameter: 0 to 1. At 0 only those at the same place do;
    /// the larger, the more detail is lost, up to a thousandth of the median side of a polygon. No effect on time.
    pub weld: f64,
}

impl Default for RepairSettings {
    fn default() -> Self {
        Self { weld: WELD_TOLERANCE }
    }
}

/// A surface made of polygons, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// The surface.
    pub mesh: Mesh,
    /// What was mended.
    pub report: RepairReport,
    /// The polygon that each face was cut from.
    pub polygons: Vec<u32>,
}

impl Repaired {
    /// The polygon that a face was cut from.
    pub fn polygon(&self, face: FaceId) -> usize {
        self.polygons[face.index()] as usize
    }
}

/// Makes an oriented manifold of polygons, whatever they are, and counts what was mended.
///
/// Polygons that are a surface already keep their vertices, corners and order, bit for bit; see [`RepairReport`] for what is done to others.
/// Scale and place of the model change nothing as long as its coordinates hold the digits. Time is near linear, O(n log n), for models that do not lie
/// in one plane across a line that is slanted so that none does; the same input gives the same bits.
///
/// # Errors
/// Where there is nothing to make a surface of, a position is no number, or an index leads nowhere.
///
/// ```
/// use glam::DVec3;
/// use pelage_mesh::{RepairSettings, Soup, repair};
///
/// // Two triangles with corners of their own, wound against each other.
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
/// let repaired = repair(Soup::from_polygons(corners.to_vec(), [[0, 1, 2], [3, 4, 5]]), &RepairSettings::default())?;
/// assert_eq!(repaired.mesh.topology().edge_count(), 5);
/// assert_eq!((repaired.report.vertices_welded, repaired.report.faces_turned), (2, 1));
/// # Ok::<(), pelage_mesh::RepairError>(())
/// ```
pub fn repair(soup: Soup, settings: &RepairSettings) -> Result<Repaired, RepairError> {
    soup.check()?;
    let polygon_count = soup.ends.len();
    let no_surface = RepairError::NoSurface { faces: polygon_count };
    let mut in_use = vec![false; soup.positions.len()];
    soup.corners.iter().for_each(|&vertex| in_use[vertex as usize] = true);
    let used = soup.positions.iter().zip(&in_use).filter(|(_, in_use)| **in_use).map(|(&p, _)| p);
    let Some(scale) = Scale::of(used) else { return Err(no_surface) };
    let mut report = RepairReport::default();
    let tolerance = settings.weld.clamp(0.0, 1.0).min(MOST_OF_AN_EDGE * scale.median_side(&soup));
    let names = weld::weld(&soup.positions, &in_use, &scale, tolerance);
    report.vertices_welded = (0..).zip(&names).filter(|&(vertex, &name)| vertex != name).count();
    let faces = polygons::cut_polygons(&soup, &names, &scale, &mut report);
    let Soup { positions, mut colours, texture_coordinates, .. } = soup;
    colours::blend_welded(&mut colours, &names, &in_use);
    let mut surface = Surface { positions, colours, texture_coordinates, faces, report };
    let topology = surface.make_manifold(&scale)?;
    if surface.faces.len() == 0 {
        return Err(no_surface);
    }
    surface.finish(topology, &scale)
}

/// Faces with their vertices, on the way to a mesh.
struct Surface {
    positions: Vec<DVec3>,
    /// One for each position, or none.
    colours: Vec<Vec4>,
    texture_coordinates: Vec<DVec2>,
    faces: Faces,
    report: RepairReport,
}

impl Surface {
    /// Mends what keeps the faces from being a manifold; most are one as they come.
    fn make_manifold(&mut self, scale: &Scale) -> Result<Topology, RepairError> {
        let places = Places { positions: &self.positions, scale };
        if places.flat_faces(&self.faces).is_empty() {
            self.drop_unreferenced();
            let topology = Topology::of_manifold(self.positions.len(), &self.faces.corners);
            if let Some(topology) = topology.filter(|topology| !has_doubled_face(topology)) {
                return Ok(topology);
            }
        }
        self.mend(scale);
        self.drop_unreferenced();
        Ok(Topology::from_triangles(self.positions.len(), &self.faces.corners).map_err(crate::MeshError::from)?)
    }

    fn mend(&mut self, scale: &Scale) {
        let (faces, report) = (&mut self.faces, &mut self.report);
        report.faces_duplicated = duplicates::drop_duplicates(faces);
        let places = Places { positions: &self.positions, scale };
        let flat = places.flat_faces(faces);
        if !flat.is_empty() {
            let flattened = flat::resolve_flat(faces, &mut self.texture_coordinates, &places, &flat);
            (report.junctions_split, report.faces_without_area) = (flattened.split, flattened.dropped);
            // A half may fall on a face that was there.
            report.faces_duplicated += duplicates::drop_duplicates(faces);
        }
        let mut mates = Mates::of(faces, &places);
        report.edges_split = mates.edges_split;
        let agreed = winding::agree(faces, &mut mates);
        (report.faces_turned, report.edges_cut) = (agreed.turned, agreed.cut);
        let split = split::split_vertices(faces, &mut mates, self.positions.len());
        (report.vertices_split, report.vertices_added) = (split.vertices, split.copies.len());
        let copies: Vec<DVec3> = split.copies.iter().map(|&vertex| self.positions[vertex as usize]).collect();
        self.positions.extend(copies);
        if !self.colours.is_empty() {
            let copies: Vec<Vec4> = split.copies.iter().map(|&vertex| self.colours[vertex as usize]).collect();
            self.colours.extend(copies);
        }
    }

    /// Drops the vertices that no face uses.
    fn drop_unreferenced(&mut self) {
        let mut in_use = vec![false; self.positions.len()];
        self.faces.corners.as_flattened().iter().for_each(|&vertex| in_use[vertex as usize] = true);
        if in_use.iter().all(|&used| used) {
            return;
        }
        let mut names = Vec::with_capacity(in_use.len());
        let mut kept = 0;
        for (vertex, &used) in in_use.iter().enumerate() {
            names.push(kept as u32);
            if used {
                self.positions[kept] = self.positions[vertex];
                if !self.colours.is_empty() {
                    self.colours[kept] = self.colours[vertex];
                }
                kept += 1;
            }
        }
        self.positions.truncate(kept);
        self.colours.truncate(kept);
        self.faces.corners.as_flattened_mut().iter_mut().for_each(|vertex| *vertex = names[*vertex as usize]);
        self.report.vertices_unreferenced += in_use.len() - kept;
    }

    /// Turns what is wound inwards, and puts the mesh together.
    fn finish(mut self, mut topology: Topology, scale: &Scale) -> Result<Repaired, RepairError> {
        self.report.pieces_turned = outward::turn_outwards(&mut self.faces, &topology, &self.positions, scale);
        if self.report.pieces_turned > 0 {
            topology = Topology::from_triangles(self.positions.len(), &self.faces.corners).map_err(crate::MeshError::from)?;
        }
        // Those that were welded away have no face either.
        self.report.vertices_unreferenced -= self.report.vertices_welded;
        let Faces { coordinates, polygons, .. } = self.faces;
        let mut mesh = Mesh::new(Arc::new(topology), self.positions)?;
        if !coordinates.is_empty() {
            let all = &self.texture_coordinates;
            mesh = mesh.with_texture_coordinates(coordinates.as_flattened().iter().map(|&index| all[index as usize]).collect())?;
        }
        if !self.colours.is_empty() {
            mesh = mesh.with_colours(self.colours)?;
        }
        Ok(Repaired { mesh, report: self.report, polygons })
    }
}

/// Whether some face lies along all three sides of another: the same face from its other side.
fn has_doubled_face(topology: &Topology) -> bool {
    topology.faces().any(|face| matches!(face.across(), [Some(a), Some(b), Some(c)] if a == b && b == c))
}
