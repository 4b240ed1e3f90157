//! How well shaped the triangles of a mesh are.

use crate::{Edge, Mesh, Vertex};

/// The shapes of the faces in figures; none of them depends on the model's size.
///
/// ```
/// let sphere = pelage_mesh::sphere(1.0, 8)?;
/// let quality = pelage_mesh::Quality::of(&sphere);
/// assert_eq!((quality.valence_min, quality.valence_max), (5, 6));
/// assert!(quality.angle_min_deg > 50.0 && quality.aspect_max < 1.1);
/// # Ok::<(), pelage_mesh::PrimitiveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// The least angle of any face, in degrees: 60 at best.
    pub angle_min_deg: f64,
    /// The greatest angle of any face, in degrees: 60 at best.
    pub angle_max_deg: f64,
    /// The longest edge over the shortest.
    pub edge_ratio: f64,
    /// The median over the faces of R / 2r, the radius of the circle around over twice that of the circle within: 1 for an equilateral face, infinite
    /// for one without area.
    pub aspect_p50: f64,
    /// The value that R / 2r exceeds at one face of a hundred.
    pub aspect_p99: f64,
    /// The greatest R / 2r.
    pub aspect_max: f64,
    /// The fewest edges at a vertex that has any.
    pub valence_min: usize,
    /// The most edges at a vertex.
    pub valence_max: usize,
}

impl Quality {
    /// The figures of a mesh; all 0 for one without faces. Time is O(F log F).
    pub fn of(mesh: &Mesh) -> Self {
        let mut aspects = Vec::with_capacity(mesh.topology().face_count());
        let (mut least, mut greatest) = (180.0_f64, 0.0_f64);
        for face in mesh.faces() {
            let angles = face.angles();
            for angle in angles {
                (least, greatest) = (least.min(angle.to_degrees()), greatest.max(angle.to_degrees()));
            }
            aspects.push(aspect(angles));
        }
        if aspects.is_empty() {
            least = 0.0;
        }
        aspects.sort_unstable_by(f64::total_cmp);
        let lengths = mesh.edges().map(Edge::length);
        let (shortest, longest) = lengths.fold((f64::INFINITY, 0.0_f64), |(low, high), length| (low.min(length), high.max(length)));
        let valences = || mesh.vertices().map(Vertex::valence).filter(|&valence| valence > 0);
        Self {
            angle_min_deg: least,
            angle_max_deg: greatest,
            edge_ratio: longest / shortest,
            aspect_p50: percentile(&aspects, 0.5),
            aspect_p99: percentile(&aspects, 0.99),
            aspect_max: percentile(&aspects, 1.0),
            valence_min: valences().min().unwrap_or(0),
            valence_max: valences().max().unwrap_or(0),
        }
    }
}

/// R / 2r = 1 / (8 sin α/2 sin β/2 sin γ/2), which stays exact where areas and lengths leave the range of `f64`.
fn aspect(angles: [f64; 3]) -> f64 {
    let product: f64 = angles.iter().map(|angle| libm::sin(0.5 * angle)).product();
    if product > 0.0 { 0.125 / product } else { f64::INFINITY }
}

/// Between the two neighbours in the sorted row, as they lie to either side of the place.
fn percentile(sorted: &[f64], part: f64) -> f64 {
    let place = part * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(&a), Some(&b)) if b.is_finite() => a + (b - a) * place.fract(),
        (Some(&a), Some(_)) => a,
        _ => 0.0,
    }
}
