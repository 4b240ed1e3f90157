//! Blurring by diffusion.

use faer::Spec;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side};
use glam::{DVec3, Vec3};
use pelage_mesh::{Edge, Face, HalfEdge, Mesh, Vertex};

use crate::error::check;
use crate::{ColourField, FieldError, ScalarField};

/// Into so many steps the diffusion is cut: one alone has a peak where it should be round, and more change the middle by under a tenth.
const STEPS: usize = 4;

/// More than the cotangent of any angle that says more than rounding.
const MOST_COTANGENT: f64 = 1e4;

/// A vertex has at least this part of the mean area, so that the equations of a piece without area have a solution.
const LEAST_AREA: f64 = 1e-12;

impl ScalarField {
    /// The field as heat would spread: blurred by a Gaussian whose deviation along the surface is `radius`, in diameters of the model, 0 to 10.
    ///
    /// The integral over the surface stays as it is, and no value leaves the range there was. Boundaries let nothing through, and other pieces of surface nothing across; 0 changes nothing.
    ///
    /// One factorisation of a sparse matrix, O(n^1.5) at worst, and four substitutions.
    ///
    /// # Errors
    /// Where the radius is out of range, the field is not of this mesh, or the equations cannot be solved.
    pub fn blurred(&self, mesh: &Mesh, radius: f64) -> Result<Self, FieldError> {
        check("the radius", radius, (0.0, 10.0))?;
        self.check(mesh)?;
        if radius == 0.0 || mesh.topology().face_count() == 0 {
            return Ok(self.clone());
        }
        let mut column: Vec<f64> = self.values().iter().map(|&value| value.into()).collect();
        Diffusion::new(mesh, radius)?.spread(&mut column, 1)?;
        Self::new(column.into_iter().map(|value| value as f32).collect())
    }
}

impl ColourField {
    /// The colours as [`ScalarField::blurred`] blurs numbers.
    ///
    /// # Errors
    /// As there.
    pub fn blurred(&self, mesh: &Mesh, radius: f64) -> Result<Self, FieldError> {
        check("the radius", radius, (0.0, 10.0))?;
        let (values, expected) = (self.values().len(), mesh.positions().len());
        if values != expected {
            return Err(FieldError::Length { values, expected });
        }
        if radius == 0.0 || mesh.topology().face_count() == 0 {
            return Ok(self.clone());
        }
        let mut columns: Vec<f64> = (0..3).flat_map(|channel| self.values().iter().map(move |colour| colour[channel].into())).collect();
        Diffusion::new(mesh, radius)?.spread(&mut columns, 3)?;
        let at = |vertex: usize| Vec3::from([0, 1, 2].map(|channel| columns[channel * expected + vertex] as f32));
        Self::new((0..expected).map(at).collect())
    }
}

/// The equations (M + τ L) u = M u₀ of an implicit step of the heat equation, factorised: M the area of each vertex, L the cotangent Laplacian (Pinkall and Polthier 1993).
///
/// The rows of L add up to zero and it is symmetric, so that Σ M u is kept. Weights that an obtuse angle would make negative are taken as zero: then no value
/// can leave the range of the others, whatever the triangles.
struct Diffusion {
    areas: Vec<f64>,
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl Diffusion {
    /// In diameters. Of a heat kernel at time t the deviation along each axis is √2t.
    fn new(mesh: &Mesh, radius: f64) -> Result<Self, FieldError> {
        let time = 0.5 * radius * radius / STEPS as f64;
        let diameter = mesh.diameter();
        let areas = areas(mesh, diameter);
        let mut diagonal = areas.clone();
        let mut entries = Vec::with_capacity(mesh.topology().edge_count() + areas.len());
        for edge in mesh.edges() {
            let weight = time * weight(edge, diameter);
            let [a, b] = edge.vertices().map(Vertex::index);
            diagonal[a] += weight;
            diagonal[b] += weight;
            entries.push(Triplet::new(a.max(b) as u32, a.min(b) as u32, -weight));
        }
        entries.extend((0..).zip(&diagonal).map(|(vertex, &value)| Triplet::new(vertex, vertex, value)));
        let (symbolic, values) = factorise(areas.len(), &entries).ok_or(FieldError::Unsolved)?;
        Ok(Self { areas, symbolic, values })
    }

    /// Takes all steps, in place.
    fn spread(&self, columns: &mut [f64], count: usize) -> Result<(), FieldError> {
        let size = self.areas.len();
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| FieldError::Unsolved)?;
        let bounds: Vec<(f64, f64)> = columns.chunks(size).map(bounds).collect();
        for _ in 0..STEPS {
            for column in columns.chunks_mut(size) {
                column.iter_mut().zip(&self.areas).for_each(|(value, area)| *value *= area);
            }
            LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(columns, size, count),
                Par::Seq,
                MemStack::new(&mut buffer),
            );
        }
        if columns.iter().any(|value| !value.is_finite()) {
            return Err(FieldError::Unsolved);
        }
        // What rounding adds.
        for (column, (least, most)) in columns.chunks_mut(size).zip(bounds) {
            column.iter_mut().for_each(|value| *value = value.clamp(least, most));
        }
        Ok(())
    }
}

fn bounds(column: &[f64]) -> (f64, f64) {
    column.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), &value| (least.min(value), most.max(value)))
}

/// Of each vertex, a third of its faces', in square diameters; for one without a face the mean, which keeps what it has.
fn areas(mesh: &Mesh, diameter: f64) -> Vec<f64> {
    let mut areas = vec![0.0; mesh.positions().len()];
    let area = |face: Face<'_, Mesh>| {
        let [a, b, c] = face.positions().map(|p| p / diameter);
        0.5 * (b - a).cross(c - a).length()
    };
    for face in mesh.faces() {
        let third = area(face) / 3.0;
        face.vertices().into_iter().for_each(|vertex| areas[vertex.index()] += third);
    }
    let mean = areas.iter().sum::<f64>() / areas.len() as f64;
    let mean = if mean > 0.0 { mean } else { 1.0 };
    let least = |area: f64, used: bool| if used { area.max(LEAST_AREA * mean) } else { mean };
    mesh.vertices().map(|vertex| least(areas[vertex.index()], vertex.is_referenced())).collect()
}

/// Half the sum of the cotangents opposite to an edge. It has no unit.
fn weight(edge: Edge<'_, Mesh>, diameter: f64) -> f64 {
    let cotangent = |side: HalfEdge<'_, Mesh>| {
        let apex = side.apex().position();
        let [a, b]: [DVec3; 2] = [side.origin(), side.tip()].map(|end| (end.position() - apex) / diameter);
        let across = a.cross(b).length();
        let cotangent = a.dot(b) / across;
        // Of a face without area, nothing.
        if cotangent.is_finite() { cotangent.min(MOST_COTANGENT) } else { 0.0 }
    };
    let both: f64 = edge.half_edges().map(cotangent).sum();
    (0.5 * both).max(0.0)
}

fn factorise(size: usize, lower: &[Triplet<u32, u32, f64>]) -> Option<(SymbolicCholesky<u32>, Vec<f64>)> {
    let matrix = SparseColMat::try_new_from_triplets(size, size, lower).ok()?;
    let symbolic =
        factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, SymmetricOrdering::Amd, CholeskySymbolicParams::default()).ok()?;
    let mut values = vec![0.0; symbolic.len_val()];
    // Always on this thread: faer's global setting is not ours to read, and the bits are the same whatever it says.
    let mut buffer = MemBuffer::try_new(symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())).ok()?;
    symbolic
        .factorize_numeric_llt(
            &mut values,
            matrix.as_ref(),
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut buffer),
            Spec::default(),
        )
        .ok()?;
    Some((symbolic, values))
}
