//! A few guide hairs that shape a whole tile.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::error::{StrandError, within};
use crate::tile::{Root, Strand, StrandTile};

/// Most guides of a tile.
pub const MAX_GUIDES: usize = 1024;
/// Most points of a guide, its root not counted.
pub const MAX_GUIDE_POINTS: usize = 64;
/// How far a guide's point may be from its root along each axis, in heights.
const FARTHEST: f64 = 8.0;
/// Straight pieces that a guide's curve is blended by.
const PIECES: usize = 64;
/// Pieces between two points of a guide before they are made even.
const FINE: usize = 16;
/// No hair's natural neighbours are further: whatever stands on the torus stands, with its copies, at every point of a unit lattice, so no empty circle is
/// wider than √2.
const NEAR: f64 = 1.4143;

/// A hair that others follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guide {
    /// Where it stands, in tile sides; whole tiles make no difference.
    pub root: [f64; 2],
    /// From its root, which is left out, to its tip: 1 to [`MAX_GUIDE_POINTS`], relative to the root, in heights of the tile's box. A smooth curve goes through them.
    pub points: Vec<[f64; 3]>,
}

/// Bends all hair of a tile along guides: hair that stood straight up follows the curve between the guides around it, and what winds about its way
/// still does. No guides leave it as it is.
///
/// Between guides the curve is that of the natural neighbours (Sibson 1981, "A brief description of natural neighbour interpolation") on the torus: at a guide it
/// is the guide's, and guides whose points are a linear function of their roots are met exactly between them. A hair half as high as the box goes half the
/// way along. Grow the hair upright (`lean` 0), or its lean comes on top. The box becomes as high as the hair then is.
///
/// ```
/// use pelage_strand::{Guide, StrandSource, StrandTile, guided};
///
/// let hair = StrandSource { points: vec![[0.25, 0.5, 0.0], [0.25, 0.5, 0.5]], radii: vec![0.01; 2], root_colour: [1.0; 3], tip_colour: [1.0; 3] };
/// let upright = StrandTile::from_strands(0.5, &[hair])?;
/// let guide = |x: f64, aside: f64| Guide { root: [x, 0.5], points: vec![[0.0, aside, 0.6]] };
/// let bent = guided(&upright, &[guide(0.0, 0.0), guide(0.5, 0.8)])?;
/// // Half way between the two guides, half as far aside, at half the box's height of what they are.
/// assert_eq!(bent.strand(0).map(|strand| strand.points[1]), Some([0.25, 0.5 + 0.4 * 0.5, 0.6 * 0.5]));
/// # Ok::<(), pelage_strand::StrandError>(())
/// ```
///
/// # Errors
/// Too many guides or points, points that are not finite, under the skin or too far, or two guides in one place.
pub fn guided(tile: &StrandTile, guides: &[Guide]) -> Result<StrandTile, StrandError> {
    if guides.len() > MAX_GUIDES {
        return Err(StrandError::ListLength { name: "guides", length: guides.len(), least: 0, most: MAX_GUIDES });
    }
    let curves: Vec<Way> = guides.iter().enumerate().map(|(index, guide)| Way::of(index, guide)).collect::<Result<_, _>>()?;
    if curves.is_empty() {
        return Ok(tile.clone());
    }
    let weights = weights(tile, &curves)?;
    let bent: Vec<Vec<[f32; 3]>> = weights.par_iter().enumerate().map(|(hair, weights)| bent(tile, hair, weights, &curves)).collect();
    let mut shaped = tile.clone();
    shaped.points = bent.into_iter().flatten().collect();
    if shaped.strand_count() > 0 {
        shaped.height = f64::from(shaped.points.iter().fold(0.0f32, |top, p| top.max(p[2])));
    }
    Ok(shaped)
}

/// A guide's curve in even pieces.
struct Way {
    root: Root,
    /// Relative to the root, in heights.
    places: Vec<DVec3>,
}

impl Way {
    fn of(index: usize, guide: &Guide) -> Result<Self, StrandError> {
        let length = guide.points.len();
        if length == 0 || length > MAX_GUIDE_POINTS {
            return Err(StrandError::ListLength { name: "guides.points", length, least: 1, most: MAX_GUIDE_POINTS });
        }
        let bad = |point| StrandError::BadGuide { guide: index, point, limit: FARTHEST };
        let root = Root::new(guide.root[0], guide.root[1]).ok_or(bad(0))?;
        let fit = |p: &[f64; 3]| p.iter().all(|c| within("", *c, -FARTHEST, FARTHEST, "").is_ok()) && p[2] >= 0.0;
        if let Some(point) = guide.points.iter().position(|p| !fit(p)) {
            return Err(bad(point + 1));
        }
        let mut knots = vec![DVec3::ZERO];
        // A point twice has no way between.
        guide.points.iter().map(|&p| DVec3::from(p)).for_each(|p| {
            if knots.last().is_none_or(|last| last.distance(p) > 1e-9) {
                knots.push(p);
            }
        });
        if knots.len() < 2 {
            return Err(bad(length));
        }
        Ok(Self { root, places: even(&smooth(&knots)) })
    }
}

/// Through all knots, centripetal Catmull and Rom 1974 (Yuksel, Schaefer and Keyser 2011: no loops between knots); straight on at the ends.
fn smooth(knots: &[DVec3]) -> Vec<DVec3> {
    if knots.len() == 2 {
        return knots.to_vec();
    }
    let last = knots.len() - 1;
    let knot = |index: isize| match index {
        -1 => 2.0 * knots[0] - knots[1],
        _ if index as usize > last => 2.0 * knots[last] - knots[last - 1],
        _ => knots[index as usize],
    };
    let mut curve = vec![knots[0]];
    for span in 0..last as isize {
        let p = [-1, 0, 1, 2].map(|step| knot(span + step));
        let mut times = [0.0; 4];
        for k in 1..4 {
            times[k] = times[k - 1] + p[k].distance(p[k - 1]).sqrt();
        }
        for fine in 1..=FINE {
            let time = times[1] + (times[2] - times[1]) * fine as f64 / FINE as f64;
            curve.push(if fine == FINE { p[2] } else { aitken(p, times, time) });
        }
    }
    curve
}

/// Barry and Goldman 1988's pyramid.
fn aitken(p: [DVec3; 4], times: [f64; 4], time: f64) -> DVec3 {
    let between = |a: DVec3, b: DVec3, from: f64, to: f64| a + (b - a) * ((time - from) / (to - from));
    let first = [0, 1, 2].map(|k| between(p[k], p[k + 1], times[k], times[k + 1]));
    let second = [0, 1].map(|k| between(first[k], first[k + 1], times[k], times[k + 2]));
    between(second[0], second[1], times[1], times[2])
}

/// The same way in [`PIECES`] steps of one length.
fn even(curve: &[DVec3]) -> Vec<DVec3> {
    let mut lengths = vec![0.0];
    for pair in curve.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
    }
    let whole = lengths[lengths.len() - 1];
    let mut places = Vec::with_capacity(PIECES + 1);
    let mut piece = 0;
    for step in 0..PIECES {
        let way = whole * step as f64 / PIECES as f64;
        while piece + 2 < lengths.len() && lengths[piece + 1] < way {
            piece += 1;
        }
        let part = (way - lengths[piece]) / (lengths[piece + 1] - lengths[piece]);
        places.push(curve[piece].lerp(curve[piece + 1], part));
    }
    places.push(curve[curve.len() - 1]);
    places
}

/// A guide or a copy of it in a tile beside.
struct Site {
    position: Point2<f64>,
    guide: usize,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// For each hair the guides around it and what each has to say, adding up to 1.
///
/// One after another: where a search begins depends on the one before, and with it the last bit of a weight.
fn weights(tile: &StrandTile, curves: &[Way]) -> Result<Vec<Vec<(usize, f64)>>, StrandError> {
    let sites = triangulated(curves)?;
    let neighbours = sites.natural_neighbor();
    let mut found = Vec::new();
    let weigh = |strand: Strand<'_>| {
        let place = Point2::new(f64::from(strand.points[0][0]), f64::from(strand.points[0][1]));
        neighbours.get_weights(place, &mut found);
        let weights: Vec<(usize, f64)> = found.iter().map(|&(site, weight)| (sites.vertex(site).data().guide, weight)).collect();
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        if (sum - 1.0).abs() < 1e-6 {
            return weights;
        }
        // Rounding alone could lead here, where a hair stands all but on a guide.
        sites.nearest_neighbor(place).map(|site| vec![(site.data().guide, 1.0)]).unwrap_or_default()
    };
    Ok(tile.strands().map(weigh).collect())
}

fn triangulated(curves: &[Way]) -> Result<DelaunayTriangulation<Site>, StrandError> {
    let mut sites = DelaunayTriangulation::new();
    let mut seen: Vec<(usize, [f32; 2])> = Vec::with_capacity(curves.len());
    for (guide, curve) in curves.iter().enumerate() {
        if let Some(&(first, _)) = seen.iter().find(|(_, root)| *root == curve.root.fraction) {
            return Err(StrandError::GuidesMeet { first, second: guide });
        }
        seen.push((guide, curve.root.fraction));
        let [x, y] = curve.root.fraction.map(f64::from);
        for (across, up) in (-2..=2).flat_map(|across| (-2..=2).map(move |up| (across, up))) {
            let position = Point2::new(x + f64::from(across), y + f64::from(up));
            let is_near = |c: f64| (-NEAR..=1.0 + NEAR).contains(&c);
            if is_near(position.x) && is_near(position.y) {
                let lost = |_| StrandError::BadGuide { guide, point: 0, limit: FARTHEST };
                sites.insert(Site { position, guide }).map_err(lost)?;
            }
        }
    }
    Ok(sites)
}

/// A hair's points about its guides' curve.
fn bent(tile: &StrandTile, hair: usize, weights: &[(usize, f64)], curves: &[Way]) -> Vec<[f32; 3]> {
    let Some(strand) = tile.strand(hair) else { return Vec::new() };
    let blended = |step: usize| weights.iter().map(|&(guide, weight)| curves[guide].places[step] * weight).sum::<DVec3>();
    let places: Vec<DVec3> = (0..=PIECES).map(blended).collect();
    let root = DVec3::from(strand.points[0].map(f64::from));
    let place = |point: &[f32; 3]| {
        let from_root = DVec3::from(point.map(f64::from)) - root;
        let along = (from_root.z / tile.height()).clamp(0.0, 1.0) * PIECES as f64;
        let piece = (along as usize).min(PIECES - 1);
        let axis = places[piece].lerp(places[piece + 1], along - piece as f64) * tile.height();
        let toward = tangent(&places, piece).lerp(tangent(&places, piece + 1), along - piece as f64).try_normalize().unwrap_or(DVec3::Z);
        let aside = DQuat::from_rotation_arc(DVec3::Z, toward) * DVec3::new(from_root.x, from_root.y, 0.0);
        let bent = root + axis + aside;
        DVec3::new(bent.x, bent.y, bent.z.max(0.0)).as_vec3().to_array()
    };
    let mut points: Vec<[f32; 3]> = strand.points.iter().map(place).collect();
    points[0] = strand.points[0];
    points
}

/// Which way a curve goes at a joint.
fn tangent(places: &[DVec3], joint: usize) -> DVec3 {
    (places[(joint + 1).min(PIECES)] - places[joint.saturating_sub(1)]).try_normalize().unwrap_or(DVec3::Z)
}
