//! The least-squares parameterisation of one patch.

use faer::Spec;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Par, Side};
use glam::DVec2;

use crate::shape::FaceShape;

/// Greatest residual of the normal equations, relative to the greatest term of their right-hand side.
const RESIDUAL: f64 = 1e-8;
/// Turns of choosing rotations and solving for them. More change the figures of whole tilings in the third digit only.
const TURNS: usize = 4;

/// The system could not be solved to the wanted residual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unsolved;

/// One patch: its faces' corners as vertex numbers, and their shapes.
pub(crate) struct Patchwork<'a> {
    pub(crate) corners: &'a [[u32; 3]],
    pub(crate) shapes: &'a [FaceShape],
}

/// What each face's map should be.
#[derive(Clone, Copy)]
pub(crate) struct Wish<'a> {
    /// The rotation of each face that takes the field to the tile's t axis; none where the patch is isotropic.
    pub(crate) rotations: Option<&'a [DVec2]>,
    /// How much nearness to it counts beside nearness of the map to some rotation.
    pub(crate) alignment: f64,
}

/// Places the vertices so that each face's map is nearly a rotation, and that nearly the wanted one.
///
/// With J the linear map of face *f*, R its rotation and F the wanted one, Σ area(f) (‖J − R‖² + λ ‖R − F‖²) is made small over J and R in
/// turn, with a single factorisation; λ is the alignment. As λ grows, R becomes F and the energy that of Praun et al. 2000 (their sum of
/// ‖φ(S) − ŝ‖² and ‖φ(T) − t̂‖² for orthonormal S and T). Where the field spreads or bends, no even density follows it exactly: a finite λ
/// lets hair turn a little rather than thin out. Without a field λ is 0 and the patch is as rigid as possible (Liu et al. 2008). Hoppe
/// recommends a conformal map there; but it lets the scale drift with the curvature, and hair would grow thinner and denser with it.
///
/// For given R the energy is Σ over sides of half the opposite cotangent times ‖(xᵢ − xⱼ) − R(pᵢ − pⱼ)‖², p being the face's flat layout
/// (Pinkall and Polthier 1993): two Poisson systems, for s and t, with one cotangent Laplacian. Written so, a patch that can be flat is
/// solved exactly whatever the weights, and the weights may be mollified.
///
/// `places` holds a first guess. The middle of the first face ends at the origin.
pub(crate) fn solve(patch: &Patchwork<'_>, wish: Wish<'_>, places: &mut [DVec2]) -> Result<(), Unsolved> {
    let system = System::factorise(patch.corners, patch.shapes, places.len())?;
    let mut rotations = vec![DVec2::X; patch.corners.len()];
    for _ in 0..TURNS {
        for (k, rotation) in rotations.iter_mut().enumerate() {
            let pull = wish.rotations.map_or(DVec2::ZERO, |r| wish.alignment * r[k]);
            *rotation = best_rotation(&patch.shapes[k], patch.corners[k].map(|c| places[c as usize]), pull);
        }
        system.correct(patch, &rotations, places)?;
    }
    let missing = missing_pull(patch, &rotations, places);
    if largest(&missing.columns) > RESIDUAL * missing.size {
        return Err(Unsolved);
    }
    if let Some(first) = patch.corners.first() {
        let centre = first.iter().map(|&c| places[c as usize]).sum::<DVec2>() / 3.0;
        places.iter_mut().for_each(|place| *place -= centre);
    }
    if places.iter().all(|p| p.is_finite()) { Ok(()) } else { Err(Unsolved) }
}

/// The sides of a face: from corner, to corner, and the corner opposite, whose weight is the side's.
const SIDES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// The rotation R that minimises ‖J − R‖² + λ ‖R − F‖² for the face's present map, `pull` being λ F.
fn best_rotation(shape: &FaceShape, places: [DVec2; 3], pull: DVec2) -> DVec2 {
    // As complex numbers: J's part that turns and scales, times `size`, twice the area.
    let (mut turning, mut size) = (DVec2::ZERO, 0.0);
    for [i, j, opposite] in SIDES {
        let flat = shape.corners[j] - shape.corners[i];
        let placed = places[j] - places[i];
        turning += shape.weights[opposite] * DVec2::new(flat.dot(placed), flat.perp_dot(placed));
        size += shape.weights[opposite] * flat.length_squared();
    }
    (turning + size * pull).try_normalize().unwrap_or(DVec2::X)
}

/// The factorised Laplacian. The first vertex is held where it is and its row left out, which makes it positive definite.
struct System {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl System {
    fn factorise(corners: &[[u32; 3]], shapes: &[FaceShape], vertex_count: usize) -> Result<Self, Unsolved> {
        let unknowns = vertex_count - 1;
        let mut diagonal = vec![0.0; vertex_count];
        let mut entries = Vec::with_capacity(3 * corners.len() + unknowns);
        for (face, shape) in corners.iter().zip(shapes) {
            for [i, j, opposite] in SIDES {
                let (low, high) = (face[i].min(face[j]), face[i].max(face[j]));
                let weight = shape.weights[opposite];
                diagonal[low as usize] += weight;
                diagonal[high as usize] += weight;
                if low > 0 {
                    entries.push(Triplet::new(high - 1, low - 1, -weight));
                }
            }
        }
        entries.extend((1..vertex_count as u32).map(|v| Triplet::new(v - 1, v - 1, diagonal[v as usize])));
        let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries).map_err(|_| Unsolved)?;
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, SymmetricOrdering::Amd, CholeskySymbolicParams::default())
                .map_err(|_| Unsolved)?;
        let mut values = vec![0.0; symbolic.len_val()];
        // Always on this thread: faer's global setting is not ours to read, and the bits are the same whatever it says.
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut buffer = MemBuffer::try_new(scratch).map_err(|_| Unsolved)?;
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
            .map_err(|_| Unsolved)?;
        Ok(Self { symbolic, values })
    }

    /// Solves for the given rotations, s and t at once, as a correction to the present places. What is missing is summed from differences
    /// along sides, so that the places at the ends of a sliver's short side come out right to each other however far they lie from the
    /// origin, and each turn mends the rounding of the last.
    fn correct(&self, patch: &Patchwork<'_>, rotations: &[DVec2], places: &mut [DVec2]) -> Result<(), Unsolved> {
        let unknowns = places.len() - 1;
        let mut columns = missing_pull(patch, rotations, places).columns;
        self.back_substitute(unknowns, &mut columns)?;
        for (k, place) in places[1..].iter_mut().enumerate() {
            *place += DVec2::new(columns[k], columns[unknowns + k]);
        }
        Ok(())
    }

    fn back_substitute(&self, unknowns: usize, columns: &mut [f64]) -> Result<(), Unsolved> {
        let mut buffer = MemBuffer::try_new(self.symbolic.solve_in_place_scratch::<f64>(2, Par::Seq)).map_err(|_| Unsolved)?;
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(columns, unknowns, 2),
            Par::Seq,
            MemStack::new(&mut buffer),
        );
        Ok(())
    }
}

/// The residual of the normal equations.
struct Pull {
    /// Two columns, s then t, without the row of the vertex that is held.
    columns: Vec<f64>,
    /// The greatest weight times length of a side, to compare it with.
    size: f64,
}

fn missing_pull(patch: &Patchwork<'_>, rotations: &[DVec2], places: &[DVec2]) -> Pull {
    let unknowns = places.len() - 1;
    let mut pull = Pull { columns: vec![0.0; 2 * unknowns], size: 0.0 };
    let mut add = |vertex: u32, force: DVec2| {
        if let Some(row) = (vertex as usize).checked_sub(1) {
            pull.columns[row] += force.x;
            pull.columns[unknowns + row] += force.y;
        }
    };
    for ((face, shape), rotation) in patch.corners.iter().zip(patch.shapes).zip(rotations) {
        for [i, j, opposite] in SIDES {
            let flat = shape.corners[i] - shape.corners[j];
            let placed = places[face[i] as usize] - places[face[j] as usize];
            let force = shape.weights[opposite] * (rotation.rotate(flat) - placed);
            add(face[i], force);
            add(face[j], -force);
            pull.size = pull.size.max(shape.weights[opposite].abs() * flat.length());
        }
    }
    pull
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| if v.is_nan() { f64::INFINITY } else { most.max(v.abs()) })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;
    use crate::shape::face_shapes;

    /// Solves a flat grid, some of its columns squeezed to needles, from a first guess that is as wrong as can be; the greatest error.
    fn error_from_nowhere(squeeze: f64) -> f64 {
        let plane = pelage_mesh::plane(10.0, 10.0, 10, 10).unwrap();
        let narrow = |x: f64| if (x / 3.0).rem_euclid(1.0) < 0.4 { 1.0 } else { squeeze };
        let at = |x: f64| (-5..x.round() as i32).map(|k| narrow(f64::from(k))).sum::<f64>();
        let places = plane.positions().iter().map(|p| glam::DVec3::new(at(p.x), 0.0, p.z)).collect();
        let mesh = plane.with_positions(places).unwrap();
        let shapes = face_shapes(&mesh, 1.0);
        let corners: Vec<[u32; 3]> = mesh.topology().triangles().collect();
        let field = pelage_field::DirectionField::toward(&mesh, glam::DVec3::X).unwrap();
        let rotations = crate::frame::face_rotations(&mesh, &field, &shapes, 1.0);
        let wish = Wish { rotations: Some(&rotations), alignment: 1e6 };
        let mut found = vec![DVec2::ZERO; mesh.positions().len()];
        solve(&Patchwork { corners: &corners, shapes: &shapes }, wish, &mut found).unwrap();
        let wanted = |v: usize| DVec2::new(mesh.positions()[v].z, mesh.positions()[v].x);
        (0..found.len()).map(|v| (found[v] - found[0] - wanted(v) + wanted(0)).length()).fold(0.0, f64::max)
    }

    #[test]
    fn a_plane_is_found_from_nowhere() {
        assert!(error_from_nowhere(1.0) < 1e-12);
        assert!(error_from_nowhere(1e-3) < 1e-10);
        assert!(error_from_nowhere(1e-6) < 1e-10);
    }

    /// On caps of a bent strip that can not be flat, down to those in which `f32` sees no height: the residual stays under the limit, and everything is finite.
    #[test]
    fn caps_leave_no_residual() {
        let mut worst = 0.0_f64;
        for height in [1e-2, 1e-4, 1e-6, 1e-8] {
            let sheet = pelage_mesh::plane(8.0, 8.0, 8, 8).unwrap();
            // Every other row of vertices lies just beside the last, in waves, and the sheet is bent.
            let place = |p: glam::DVec3| {
                let row = (p.x + 4.0).round();
                let x = if row % 2.0 == 1.0 { row - 1.0 + height * (1.0 + 0.3 * (3.0 * p.z).sin()) } else { row };
                glam::DVec3::new(x, 0.05 * p.z * p.z + 0.1 * x.sin(), p.z)
            };
            let mesh = sheet.with_positions(sheet.positions().iter().map(|&p| place(p)).collect()).unwrap();
            let shapes = face_shapes(&mesh, 1.0);
            let corners: Vec<[u32; 3]> = mesh.topology().triangles().collect();
            let patch = Patchwork { corners: &corners, shapes: &shapes };
            let mut places: Vec<DVec2> = mesh.positions().iter().map(|p| DVec2::new(p.z, p.x)).collect();
            let system = System::factorise(&corners, &shapes, places.len()).unwrap();
            let rotations: Vec<DVec2> = shapes
                .iter()
                .zip(&corners)
                .map(|(shape, face)| best_rotation(shape, face.map(|c| places[c as usize]), DVec2::ZERO))
                .collect();
            system.correct(&patch, &rotations, &mut places).unwrap();
            let missing = missing_pull(&patch, &rotations, &places);
            let residual = largest(&missing.columns) / missing.size;
            assert!(residual < 1e-8, "{residual} at {height}");
            worst = worst.max(residual);
            solve(&patch, Wish { rotations: None, alignment: 0.0 }, &mut places).unwrap();
            assert!(places.iter().all(|place| place.is_finite()));
        }
        println!("reached: residual {worst:.0e}");
    }
}
