//! Fewer faces, by meshoptimizer.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use meshopt::{SimplifyOptions, simplify_decoder};

use crate::{Mesh, RepairError, RepairReport, RepairSettings, Soup, repair};

/// How far [`simplify`] goes. It stops at whatever comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplifySettings {
    /// How many of the faces are to be left, 0 to 1; 1 removes only what is within the error, which then should be small.
    pub share: f64,
    /// How far the surface may leave its place, in diameters of the model, 0 to 1. The library estimates it from the mean square distance to planes:
    /// single vertices have been seen five times as far off. Under 0.0005 it is but the rounding of `f32`.
    pub error: f64,
    /// Whether vertices on the boundary stay where they are.
    pub keep_boundary: bool,
}

impl Default for SimplifySettings {
    /// A quarter of the faces, however far that takes the surface.
    fn default() -> Self {
        Self { share: 0.25, error: 1.0, keep_boundary: false }
    }
}

/// A mesh with fewer faces, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Simplified {
    /// The surface. Its vertices are some of those that there were.
    pub mesh: Mesh,
    /// How far it has left its place, as the library estimates it, in diameters of the model.
    pub error: f64,
    /// What had to be mended of the library's triangles.
    pub repairs: RepairReport,
}

/// Why a mesh cannot be simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SimplifyError {
    /// The share is none.
    #[error("the share of faces to keep is {0}; give a number from 0 to 1")]
    Share(f64),
    /// The error is none.
    #[error("the error is {0}; give a fraction of the model's diameter from 0 to 1")]
    Error(f64),
    /// The mesh has no faces.
    #[error("the mesh has no faces to simplify")]
    NoSurface,
    /// Of what is left no surface can be made.
    #[error("nothing is left of the surface ({0}); keep more faces, or allow less error")]
    Nothing(#[from] RepairError),
}

/// Takes faces away where they are missed least: edges are collapsed by their quadric error (Garland and Heckbert 1997) as `meshoptimizer` does it, to one of
/// their ends, so that vertices, their colours and texture coordinates are some of those there were. Texture seams stay seams.
///
/// It works in `f32` within the model's box, in time near linear. The triangles are [repaired](crate::repair), as a collapse may leave an edge with more than two.
///
/// # Errors
/// Where a setting is out of range, or nothing is left.
///
/// ```
/// use pelage_mesh::{SimplifySettings, simplify, sphere};
///
/// let ball = sphere(1.0, 40)?;
/// let coarse = simplify(&ball, &SimplifySettings { share: 0.1, ..SimplifySettings::default() })?;
/// assert!(coarse.mesh.topology().face_count() <= 3200 && coarse.error < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simplify(mesh: &Mesh, settings: &SimplifySettings) -> Result<Simplified, SimplifyError> {
    if !(0.0..=1.0).contains(&settings.share) {
        return Err(SimplifyError::Share(settings.share));
    }
    if !(0.0..=1.0).contains(&settings.error) {
        return Err(SimplifyError::Error(settings.error));
    }
    let faces = mesh.topology().face_count();
    let Some((low, high)) = mesh.bounds().filter(|_| faces > 0) else { return Err(SimplifyError::NoSurface) };
    let (centre, diameter) = (0.5 * low + 0.5 * high, mesh.diameter().max(f64::MIN_POSITIVE));
    let wedges = Wedges::of(mesh);
    let place = |&vertex: &u32| ((mesh.positions()[vertex as usize] - centre) / diameter).as_vec3().to_array();
    let places: Vec<[f32; 3]> = wedges.vertices.iter().map(place).collect();
    let mut options = SimplifyOptions::ErrorAbsolute;
    options.set(SimplifyOptions::LockBorder, settings.keep_boundary);
    let target = 3 * (settings.share * faces as f64).ceil() as usize;
    let mut error = 0.0_f32;
    let corners = simplify_decoder(&wedges.corners, &places, target, settings.error as f32, options, Some(&mut error));
    let repaired = repair(wedges.soup(mesh, &corners), &RepairSettings { weld: 0.0 })?;
    Ok(Simplified { mesh: repaired.mesh, error: f64::from(error), repairs: repaired.report })
}

/// Vertices told apart by their texture coordinates: the library knows no corners.
struct Wedges {
    /// The vertex of each wedge.
    vertices: Vec<u32>,
    /// Its texture coordinates; empty where there are none.
    coordinates: Vec<DVec2>,
    /// The wedge of each corner.
    corners: Vec<u32>,
}

impl Wedges {
    fn of(mesh: &Mesh) -> Self {
        let vertices_of_corners = || mesh.topology().triangles().flatten();
        let Some(coordinates) = mesh.texture_coordinates() else {
            let vertices = (0..mesh.positions().len() as u32).collect();
            return Self { vertices, coordinates: Vec::new(), corners: vertices_of_corners().collect() };
        };
        let mut wedges = Self { vertices: Vec::new(), coordinates: Vec::new(), corners: Vec::with_capacity(coordinates.len()) };
        let mut known: HashMap<(u32, [u64; 2]), u32> = HashMap::new();
        for (vertex, at) in vertices_of_corners().zip(coordinates) {
            let wedge = *known.entry((vertex, at.to_array().map(f64::to_bits))).or_insert_with(|| {
                wedges.vertices.push(vertex);
                wedges.coordinates.push(*at);
                wedges.vertices.len() as u32 - 1
            });
            wedges.corners.push(wedge);
        }
        wedges
    }

    /// Some of the triangles, by their wedges, with all that the mesh has.
    fn soup(&self, mesh: &Mesh, corners: &[u32]) -> Soup {
        let positions: Vec<DVec3> = mesh.positions().to_vec();
        Soup {
            positions,
            colours: mesh.colours().map_or_else(Vec::new, <[_]>::to_vec),
            texture_coordinates: self.coordinates.clone(),
            corners: corners.iter().map(|&wedge| self.vertices[wedge as usize]).collect(),
            corner_coordinates: if self.coordinates.is_empty() { Vec::new() } else { corners.to_vec() },
            ends: (1..=corners.len() as u32 / 3).map(|triangle| 3 * triangle).collect(),
        }
    }
}
