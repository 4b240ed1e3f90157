//! Splotch outlines cut into charts, face by face, by constrained Delaunay triangulation.
//!
//! Two rings are cut into each chart: the outline, where a patch is not there any more, and the one inside from which on it fades. What a ring's segments and a chart's edges have in common is worked
//! out once for both faces of an edge, so that their triangles meet.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use pelage_mesh::{Mesh, SurfacePoint, Vertex, VertexId};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::WHOLE;
use crate::growth::Draft;

/// Segments of a ring.
const SEGMENTS: usize = 20;

/// A triangle of less than this part of its face's area is none: points of an edge are off it by rounding, by no more than that.
const SLIVER: f64 = 1e-13;

/// A patch as it is cut.
pub(super) struct Clipped {
    pub(super) points: Vec<SurfacePoint>,
    pub(super) places: Vec<DVec2>,
    pub(super) opacities: Vec<f32>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The corners of each of a draft's faces, as numbers of its vertices.
pub(super) fn corners(draft: &Draft, mesh: &Mesh) -> Vec<[u32; 3]> {
    let numbers: HashMap<VertexId, u32> = draft.vertices.iter().zip(0u32..).map(|(&vertex, number)| (vertex, number)).collect();
    let number = |vertex: Vertex<'_, Mesh>| numbers.get(&vertex.id()).copied().unwrap_or_default();
    draft.faces.iter().map(|&face| mesh.face(face).vertices().map(number)).collect()
}

/// A point that triangles have for a corner, told from all others of its patch.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Corner {
    /// A vertex of the chart.
    Vertex(u32),
    /// Where an edge, its lower vertex first, meets a segment of a ring.
    Crossing { edge: [u32; 2], ring: usize, segment: usize },
    /// A point of a ring, in a face: a chart that winds around may have it in several.
    Ring { ring: usize, point: usize, face: usize },
}

/// Cuts a draft whose faces have these corners; its places are moved by `shift` at last.
pub(super) fn clipped(draft: &Draft, corners: &[[u32; 3]], shift: DVec2) -> Clipped {
    let rings = [1.0, WHOLE].map(|scale| ring(draft, scale));
    let mut cutting = Cutting {
        draft,
        rings,
        numbers: HashMap::new(),
        out: Clipped { points: Vec::new(), places: Vec::new(), opacities: Vec::new(), triangles: Vec::new() },
    };
    for (face, &corners) in corners.iter().enumerate() {
        cutting.face(face, corners);
    }
    cutting.out.places.iter_mut().for_each(|place| *place += shift);
    cutting.out
}

/// The points of a ring, anticlockwise.
fn ring(draft: &Draft, scale: f64) -> Vec<DVec2> {
    let turn = |k: usize| std::f64::consts::TAU * (k as f64 + 0.5) / SEGMENTS as f64;
    let towards = |k: usize| DVec2::new(libm::cos(turn(k)), libm::sin(turn(k)));
    (0..SEGMENTS).map(|k| towards(k) * (scale * draft.splotch.radius_towards(towards(k)))).collect()
}

struct Cutting<'a> {
    draft: &'a Draft,
    rings: [Vec<DVec2>; 2],
    numbers: HashMap<Corner, u32>,
    out: Clipped,
}

impl Cutting<'_> {
    /// Adds what of a face lies within the outline.
    fn face(&mut self, face: usize, corners: [u32; 3]) {
        let places = corners.map(|corner| self.draft.places[corner as usize]);
        let area = doubled_area(places);
        if area.is_nan() || area <= 0.0 {
            return;
        }
        let mut pieces = Pieces { corners: corners.map(Corner::Vertex).to_vec(), places: places.to_vec(), constraints: Vec::new() };
        let mut on_edges: [Vec<(f64, usize)>; 3] = [Vec::new(), Vec::new(), Vec::new()];
        for ring in 0..self.rings.len() {
            self.cut(ring, (face, corners), places, &mut pieces, &mut on_edges);
        }
        if pieces.corners.len() == 3 {
            self.keep(face, corners, places, &pieces, [0, 1, 2]);
            return;
        }
        for (side, mut points) in on_edges.into_iter().enumerate() {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let row: Vec<usize> = std::iter::once(side).chain(points.into_iter().map(|(_, point)| point)).chain([(side + 1) % 3]).collect();
            pieces.constraints.extend(row.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        for triangle in pieces.triangles() {
            if doubled_area(triangle.map(|k| pieces.places[k])) > SLIVER * area {
                self.keep(face, corners, places, &pieces, triangle);
            }
        }
    }

    /// Adds to a face's pieces what a ring has in it.
    fn cut(
        &self,
        ring: usize,
        (face, corners): (usize, [u32; 3]),
        places: [DVec2; 3],
        pieces: &mut Pieces,
        on_edges: &mut [Vec<(f64, usize)>; 3],
    ) {
        let points = &self.rings[ring];
        let inside: Vec<bool> = points.iter().map(|&point| contains(places, point)).collect();
        let mut numbers: Vec<Option<usize>> = vec![None; points.len()];
        for (point, _) in inside.iter().enumerate().filter(|(_, inside)| **inside) {
            numbers[point] = Some(pieces.push(Corner::Ring { ring, point, face }, points[point]));
        }
        for segment in 0..points.len() {
            let next = (segment + 1) % points.len();
            let (from, to) = (points[segment], points[next]);
            // What of the segment is met, from its start to its end.
            let mut met: Vec<(f64, usize)> = Vec::new();
            met.extend(numbers[segment].map(|point| (0.0, point)));
            for side in 0..3 {
                let ends = [corners[side], corners[(side + 1) % 3]];
                let edge = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let [low, high] = edge.map(|corner| self.draft.places[corner as usize]);
                let Some((along_edge, along)) = crossing(low, high, from, to) else { continue };
                let point = pieces.push(Corner::Crossing { edge, ring, segment }, low.lerp(high, along_edge));
                on_edges[side].push((if ends[0] == edge[0] { along_edge } else { 1.0 - along_edge }, point));
                met.push((along, point));
            }
            met.extend(numbers[next].map(|point| (1.0, point)));
            met.sort_by(|a, b| a.0.total_cmp(&b.0));
            for pair in met.windows(2) {
                if contains(places, 0.5 * (pieces.places[pair[0].1] + pieces.places[pair[1].1])) {
                    pieces.constraints.push([pair[0].1, pair[1].1]);
                }
            }
        }
    }

    /// Keeps a triangle of a face, if it lies within the outline.
    fn keep(&mut self, face: usize, corners: [u32; 3], places: [DVec2; 3], pieces: &Pieces, triangle: [usize; 3]) {
        let middle = triangle.iter().map(|&k| pieces.places[k]).sum::<DVec2>() / 3.0;
        if !within(&self.rings[0], middle) {
            return;
        }
        let triangle = triangle.map(|k| self.number(face, corners, places, pieces.corners[k], pieces.places[k]));
        self.out.triangles.push(triangle);
    }

    /// The number of a corner among the patch's vertices; a new one if it is new.
    fn number(&mut self, face: usize, corners: [u32; 3], places: [DVec2; 3], corner: Corner, place: DVec2) -> u32 {
        if let Some(&number) = self.numbers.get(&corner) {
            return number;
        }
        let number = self.out.places.len() as u32;
        self.numbers.insert(corner, number);
        self.out.points.push(SurfacePoint { face: self.draft.faces[face], barycentrics: barycentrics(corners, places, corner, place) });
        self.out.places.push(place);
        self.out.opacities.push(match corner {
            Corner::Vertex(_) => self.opacity(place),
            Corner::Crossing { ring, .. } | Corner::Ring { ring, .. } => ring as f32,
        });
        number
    }

    /// 1 within the inner ring, and from there down to 0 at the outline.
    fn opacity(&self, place: DVec2) -> f32 {
        let part = place.length() / self.draft.splotch.radius_towards(place);
        ((1.0 - part) / (1.0 - WHOLE)).clamp(0.0, 1.0) as f32
    }
}

/// Of a face: its corners, what rings add to them, and edges that have to be.
struct Pieces {
    corners: Vec<Corner>,
    places: Vec<DVec2>,
    constraints: Vec<[usize; 2]>,
}

impl Pieces {
    fn push(&mut self, corner: Corner, place: DVec2) -> usize {
        self.corners.push(corner);
        self.places.push(place);
        self.places.len() - 1
    }

    /// Anticlockwise triangles between all points. An edge that rounding lets cross another is left out: the triangles stay whole.
    fn triangles(&self) -> Vec<[usize; 3]> {
        let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        let mut handles = Vec::with_capacity(self.places.len());
        let mut first: HashMap<usize, usize> = HashMap::new();
        for (index, place) in self.places.iter().enumerate() {
            // Coordinates that cannot be are of no use to anybody.
            let Ok(handle) = triangulation.insert(Point2::new(place.x, place.y)) else { return Vec::new() };
            first.entry(handle.index()).or_insert(index);
            handles.push(handle);
        }
        for &[from, to] in &self.constraints {
            if handles[from] != handles[to] {
                let _ = triangulation.try_add_constraint(handles[from], handles[to]);
            }
        }
        let corner = |handle: spade::handles::FixedVertexHandle| first.get(&handle.index()).copied().unwrap_or_default();
        triangulation.inner_faces().map(|face| face.vertices().map(|vertex| corner(vertex.fix()))).collect()
    }
}

/// Twice the area, positive if they wind anticlockwise.
fn doubled_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

fn contains(triangle: [DVec2; 3], point: DVec2) -> bool {
    (0..3).all(|side| doubled_area([triangle[side], triangle[(side + 1) % 3], point]) >= 0.0)
}

/// Whether a closed ring of points winds around a place.
fn within(ring: &[DVec2], place: DVec2) -> bool {
    let crosses = |k: usize| {
        let (a, b) = (ring[k] - place, ring[(k + 1) % ring.len()] - place);
        // An edge upwards to the right of the place, or downwards to its left.
        (a.y <= 0.0) != (b.y <= 0.0) && (a.perp_dot(b) > 0.0) == (b.y > a.y)
    };
    (0..ring.len()).filter(|&k| crosses(k)).count() % 2 == 1
}

/// Where an edge and a segment cross, as parts of either; none where they are parallel or miss each other.
fn crossing(low: DVec2, high: DVec2, from: DVec2, to: DVec2) -> Option<(f64, f64)> {
    let (edge, segment) = (high - low, to - from);
    let across = edge.perp_dot(segment);
    let along_edge = (from - low).perp_dot(segment) / across;
    let along = (from - low).perp_dot(edge) / across;
    let met = across != 0.0 && (0.0..1.0).contains(&along_edge) && (0.0..1.0).contains(&along);
    met.then_some((along_edge, along))
}

/// Of a corner in a face; exact for the face's own.
fn barycentrics(corners: [u32; 3], places: [DVec2; 3], corner: Corner, place: DVec2) -> DVec3 {
    if let Corner::Vertex(vertex) = corner {
        return DVec3::from_array(corners.map(|own| f64::from(u8::from(own == vertex))));
    }
    let whole = doubled_area(places);
    let part = |k: usize| (doubled_area([places[(k + 1) % 3], places[(k + 2) % 3], place]) / whole).clamp(0.0, 1.0);
    let parts = DVec3::new(part(0), part(1), part(2));
    parts / parts.element_sum()
}
