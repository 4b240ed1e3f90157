//! Noise in space.

use glam::DVec3;
use noise::core::worley::{ReturnType, distance_functions};
use noise::{NoiseFn, OpenSimplex, Perlin, Worley};
use pelage_mesh::Mesh;

use crate::error::check;
use crate::{FieldError, ScalarField};

/// What noise looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseKind {
    /// Clouds: gradient noise on a cubic grid (Perlin 2002).
    Perlin,
    /// Clouds without the grid's axes to be seen: gradient noise on a simplicial grid (OpenSimplex).
    Simplex,
    /// Dots: 0 at random places, one to a cell, and rising with the distance from the nearest (Worley 1996).
    Dots,
    /// Patches: one number for all that is nearest to the same place.
    Patches,
}

/// Noise by its looks, its size and a seed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// What it looks like.
    pub kind: NoiseKind,
    /// The side of a cell, in diameters of the model: 0.005 to 100. The pattern repeats after 256 cells.
    pub size: f64,
    /// How many layers are added, each of half the size of the one before: 1 to 12.
    pub octaves: u32,
    /// How strong each layer is beside the one before, 0 to 1.
    pub roughness: f64,
    /// Which noise.
    pub seed: u32,
}

impl Default for Noise {
    fn default() -> Self {
        Self { kind: NoiseKind::Perlin, size: 0.15, octaves: 3, roughness: 0.5, seed: 1 }
    }
}

/// The middle of the model would lie on a corner of the grid, where gradient noise is the same for all seeds.
const OFFSET: DVec3 = DVec3::new(17.31, 5.27, 91.73);

impl ScalarField {
    /// Noise at each vertex, 0 to 1 with a mean of about a half. It depends on where the vertex is in the model's box, and on nothing else: another triangulation has the same noise.
    ///
    /// # Errors
    /// Where a setting is out of range, or the mesh has no faces.
    pub fn noise(mesh: &Mesh, noise: &Noise) -> Result<Self, FieldError> {
        check("the size of the noise", noise.size, (0.005, 100.0))?;
        check("the number of octaves", f64::from(noise.octaves), (1.0, 12.0))?;
        check("the roughness", noise.roughness, (0.0, 1.0))?;
        let (low, high) = mesh.bounds().ok_or(FieldError::NoSurface)?;
        let (centre, diameter) = (0.5 * low + 0.5 * high, mesh.diameter());
        let layers = layers(noise);
        let total: f64 = layers.iter().map(|layer| layer.strength).sum();
        let at = |p: DVec3| {
            let place = (p - centre) / diameter;
            let sum: f64 = layers.iter().map(|layer| layer.strength * (layer.basis)(place / layer.size + OFFSET)).sum();
            (sum / total).clamp(0.0, 1.0) as f32
        };
        // Vertices that no face uses may be anywhere.
        let used = |vertex: pelage_mesh::Vertex<'_, Mesh>| if vertex.is_referenced() { at(vertex.position()) } else { 0.0 };
        Self::new(mesh.vertices().map(used).collect())
    }
}

/// One octave.
struct Layer {
    basis: Box<dyn Fn(DVec3) -> f64>,
    size: f64,
    strength: f64,
}

fn layers(noise: &Noise) -> Vec<Layer> {
    let mut layers = Vec::new();
    let (mut size, mut strength) = (noise.size, 1.0);
    for octave in 0..noise.octaves {
        // So that no octave repeats another one's places.
        let basis = basis(noise.kind, noise.seed.wrapping_add(octave.wrapping_mul(0x9e37_79b9)));
        layers.push(Layer { basis, size, strength });
        (size, strength) = (0.5 * size, strength * noise.roughness);
    }
    layers
}

/// A noise function with values of about 0 to 1.
fn basis(kind: NoiseKind, seed: u32) -> Box<dyn Fn(DVec3) -> f64> {
    match kind {
        NoiseKind::Perlin => {
            let perlin = Perlin::new(seed);
            Box::new(move |p| 0.5 + 0.5 * perlin.get(p.to_array()))
        }
        NoiseKind::Simplex => {
            let simplex = OpenSimplex::new(seed);
            // Its values go from −0.5 to 0.5.
            Box::new(move |p| 0.5 + simplex.get(p.to_array()))
        }
        NoiseKind::Dots => {
            let worley = Worley::new(seed).set_return_type(ReturnType::Distance).set_distance_function(distance_functions::euclidean);
            Box::new(move |p| 0.5 + 0.5 * worley.get(p.to_array()))
        }
        NoiseKind::Patches => {
            let worley = Worley::new(seed).set_return_type(ReturnType::Value).set_distance_function(distance_functions::euclidean);
            Box::new(move |p| 0.5 + 0.5 * worley.get(p.to_array()))
        }
    }
}
