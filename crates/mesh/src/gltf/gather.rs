//! All primitives of a scene as polygons.

use glam::{DMat4, DVec2, DVec3, Vec4};
use gltf::Primitive;
use gltf::mesh::{Mode, Semantic};

use super::beside::Buffers;
use super::error::{GltfError, GltfFault};
use super::scene::Placed;
use super::{GltfNote, MOST_GLTF_FACES, WHITE, accessor};
use crate::{RepairError, Soup};

/// Polygons, and where they come from.
pub(super) struct Gathered {
    pub(super) soup: Soup,
    pub(super) primitives: Primitives,
    /// The materials in use, by their number in the document; none is the default one.
    pub(super) materials: Vec<Option<usize>>,
    /// Which of `materials` each polygon has.
    pub(super) material_of_polygon: Vec<u32>,
    pub(super) notes: Vec<GltfNote>,
}

/// Where the vertices of each primitive start among all.
#[derive(Default)]
pub(super) struct Primitives(Vec<Start>);

struct Start {
    vertex: usize,
    mesh: usize,
    primitive: usize,
}

impl Primitives {
    /// Says of what cannot be mended in which primitive it is.
    pub(super) fn locate(&self, error: RepairError) -> GltfError {
        let (vertex, what) = match error {
            RepairError::NotFinite { vertex } => (vertex as usize, "coordinates"),
            other => return GltfFault::Repair(other).into(),
        };
        let after = self.0.partition_point(|start| start.vertex <= vertex);
        match after.checked_sub(1).map(|place| &self.0[place]) {
            Some(start) => {
                GltfFault::NotFinite { mesh: start.mesh, primitive: start.primitive, vertex: vertex - start.vertex, what }.into()
            }
            None => GltfFault::Repair(RepairError::NotFinite { vertex: vertex as u32 }).into(),
        }
    }
}

impl Gathered {
    pub(super) fn from(placed: &[Placed<'_>], buffers: &mut Buffers<'_, '_>) -> Result<Self, GltfFault> {
        let mut gathered = Self {
            soup: Soup::default(),
            primitives: Primitives::default(),
            materials: Vec::new(),
            material_of_polygon: Vec::new(),
            notes: Vec::new(),
        };
        let (mut not_triangles, mut morphed, mut skinned) = (0, 0, 0);
        for place in placed {
            skinned += usize::from(place.skinned);
            for primitive in place.mesh.primitives() {
                if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
                    not_triangles += 1;
                    continue;
                }
                morphed += usize::from(primitive.morph_targets().len() > 0);
                gathered.add(place, &primitive, buffers)?;
            }
        }
        if gathered.soup.ends.is_empty() {
            return Err(GltfFault::NoFaces);
        }
        let counted = [
            (not_triangles, GltfNote::NotTriangles { primitives: not_triangles }),
            (skinned, GltfNote::Skins { meshes: skinned }),
            (morphed, GltfNote::MorphTargets { primitives: morphed }),
        ];
        gathered.notes.extend(counted.into_iter().filter(|(count, _)| *count > 0).map(|(_, note)| note));
        gathered.fill_in();
        Ok(gathered)
    }

    fn add(&mut self, place: &Placed<'_>, primitive: &Primitive<'_>, buffers: &mut Buffers<'_, '_>) -> Result<(), GltfFault> {
        let (mesh, number) = (place.mesh.index(), primitive.index());
        let at = primitive.get(&Semantic::Positions).ok_or(GltfFault::NoPositions { mesh, primitive: number })?;
        let positions = accessor::positions(&at, buffers)?;
        let count = positions.len();
        let triangles = triangles(primitive, count, buffers)?;
        let soup = &mut self.soup;
        if soup.ends.len() + triangles.len() > MOST_GLTF_FACES || soup.positions.len() + count > 3 * MOST_GLTF_FACES {
            return Err(GltfFault::TooManyFaces);
        }
        if let Some(&index) = triangles.as_flattened().iter().find(|&&index| index as usize >= count) {
            return Err(GltfFault::VertexOutOfRange { mesh, primitive: number, index, count });
        }
        let first = soup.positions.len();
        self.primitives.0.push(Start { vertex: first, mesh, primitive: number });
        soup.positions.extend(positions.iter().map(|&p| place.transform.transform_point3(DVec3::from(p.map(f64::from)))));
        let mirrored = determinant(&place.transform) < 0.0;
        for &[a, b, c] in &triangles {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            soup.corners.extend(corners.map(|corner| corner + first as u32));
            soup.ends.push(soup.corners.len() as u32);
        }
        let material = self.material(primitive.material().index());
        self.material_of_polygon.extend(std::iter::repeat_n(material, triangles.len()));
        self.add_colours(mesh, primitive, (first, count), buffers)?;
        self.add_coordinates(mesh, primitive, (first, count), buffers)
    }

    /// Its number among those in use.
    fn material(&mut self, index: Option<usize>) -> u32 {
        let known = self.materials.iter().position(|&known| known == index);
        known.unwrap_or_else(|| {
            self.materials.push(index);
            self.materials.len() - 1
        }) as u32
    }

    fn add_colours(
        &mut self,
        mesh: usize,
        primitive: &Primitive<'_>,
        (first, count): (usize, usize),
        buffers: &mut Buffers<'_, '_>,
    ) -> Result<(), GltfFault> {
        let Some(source) = primitive.get(&Semantic::Colors(0)) else { return Ok(()) };
        let colours = accessor::colours(&source, buffers)?;
        check_count(mesh, primitive, "colours", colours.len(), count)?;
        if let Some(vertex) = colours.iter().position(|colour| !colour.iter().all(|c| c.is_finite())) {
            return Err(GltfFault::NotFinite { mesh, primitive: primitive.index(), vertex, what: "colours" });
        }
        self.soup.colours.resize(first, WHITE);
        self.soup.colours.extend(colours.into_iter().map(|colour| Vec4::from(colour).clamp(Vec4::ZERO, Vec4::ONE)));
        Ok(())
    }

    /// One pair for each vertex, v turned upwards.
    fn add_coordinates(
        &mut self,
        mesh: usize,
        primitive: &Primitive<'_>,
        (first, count): (usize, usize),
        buffers: &mut Buffers<'_, '_>,
    ) -> Result<(), GltfFault> {
        let set = primitive.material().pbr_metallic_roughness().base_color_texture().map_or(0, |texture| texture.tex_coord());
        let Some(source) = primitive.get(&Semantic::TexCoords(set)) else { return Ok(()) };
        let coordinates = accessor::texture_coordinates(&source, buffers)?;
        check_count(mesh, primitive, "texture coordinates", coordinates.len(), count)?;
        if let Some(vertex) = coordinates.iter().position(|at| !at.iter().all(|c| c.is_finite())) {
            return Err(GltfFault::NotFinite { mesh, primitive: primitive.index(), vertex, what: "texture coordinates" });
        }
        self.soup.texture_coordinates.resize(first, DVec2::ZERO);
        let turned = coordinates.into_iter().map(|[u, v]| DVec2::new(f64::from(u), 1.0 - f64::from(v)));
        self.soup.texture_coordinates.extend(turned);
        Ok(())
    }

    /// Gives what primitives lack that others have.
    fn fill_in(&mut self) {
        let soup = &mut self.soup;
        if !soup.colours.is_empty() {
            soup.colours.resize(soup.positions.len(), WHITE);
        }
        if !soup.texture_coordinates.is_empty() {
            soup.texture_coordinates.resize(soup.positions.len(), DVec2::ZERO);
            soup.corner_coordinates.clone_from(&soup.corners);
        }
    }
}

fn check_count(mesh: usize, primitive: &Primitive<'_>, what: &'static str, found: usize, positions: usize) -> Result<(), GltfFault> {
    if found == positions { Ok(()) } else { Err(GltfFault::Count { mesh, primitive: primitive.index(), what, found, positions }) }
}

/// The sign of how volumes change: negative where left and right are swapped.
fn determinant(transform: &DMat4) -> f64 {
    let [x, y, z] = [transform.x_axis, transform.y_axis, transform.z_axis].map(|axis| crate::unit(axis.truncate()));
    x.cross(y).dot(z)
}

/// The corners of each triangle; what does not fill the last one is left out, as the format says.
fn triangles(primitive: &Primitive<'_>, vertices: usize, buffers: &mut Buffers<'_, '_>) -> Result<Vec<[u32; 3]>, GltfFault> {
    let indices = match primitive.indices() {
        Some(source) => accessor::indices(&source, buffers)?,
        None => (0..u32::try_from(vertices).map_err(|_| GltfFault::TooManyFaces)?).collect(),
    };
    Ok(match primitive.mode() {
        Mode::TriangleStrip => {
            let each = |(k, w): (usize, &[u32])| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
            indices.windows(3).enumerate().map(each).collect()
        }
        Mode::TriangleFan => indices.get(1..).unwrap_or_default().windows(2).map(|w| [indices[0], w[0], w[1]]).collect(),
        _ => indices.as_chunks::<3>().0.to_vec(),
    })
}
