//! The coverage of a layer by definition, by many samples: what the closed form is measured against. Shares nothing with the sampler.

use pelage_strand::{Strand, StrandTile};
use std::f64::consts::TAU;

/// A layer to be sampled exactly.
#[derive(Clone, Copy)]
pub(crate) struct ExactLayer {
    /// Height above the skin, tile sides.
    pub(crate) height: f64,
    /// Half the height within which hair covers fully, tile sides.
    pub(crate) core: f64,
    /// Deviation of the tall Gaussian beyond the core, tile sides.
    pub(crate) vertical: f64,
    /// Texels along a tile side.
    pub(crate) resolution: u32,
    /// Lateral deviation in texels, beside the texel's box.
    pub(crate) lateral: f64,
}

impl ExactLayer {
    /// Expected coverage of a texel: the mean over `samples` places in its footprint. All hairs share the slab's random height.
    pub(crate) fn coverage(&self, hair: &StrandTile, x: u32, y: u32, samples: u32) -> f64 {
        let side = f64::from(self.resolution);
        let centre = [(f64::from(x) + 0.5) / side, (f64::from(y) + 0.5) / side];
        // Places further out than this are less likely than one in 1e7.
        let near = self.near(hair, centre, (0.75 + 5.7 * self.lateral) / side);
        let mut sum = 0.0;
        for number in 0..samples {
            let [bx, by, ga, gb] = sequence(number);
            // The Gaussian by Box and Muller.
            let far = self.lateral * (-2.0 * (1.0 - ga).ln()).sqrt();
            let place = [f64::from(x) + bx + far * (TAU * gb).cos(), f64::from(y) + by + far * (TAU * gb).sin()];
            sum += self.at(&near, place.map(|c| c / side));
        }
        sum / f64::from(samples)
    }

    /// The probability that a place (tile sides) is covered: exp(−d²/2) where d is how far, in vertical deviations, the hair over it that comes nearest to
    /// the layer stays outside its core.
    fn at(&self, near: &[(Strand<'_>, [f64; 2])], place: [f64; 2]) -> f64 {
        let mut best = f64::INFINITY;
        for (strand, image) in near {
            let place = [place[0] + image[0], place[1] + image[1]];
            for (points, radii) in strand.points.windows(2).zip(strand.radii.windows(2)) {
                best = best.min(self.nearest_on(points, radii, place));
            }
        }
        let beyond = (best - self.core).max(0.0) / self.vertical;
        (-0.5 * beyond * beyond).exp()
    }

    /// The strands, as far as the layer feels them at all, and which periodic image of the place they are nearest to, that come within `margin` of it.
    fn near<'a>(&self, hair: &'a StrandTile, place: [f64; 2], margin: f64) -> Vec<(Strand<'a>, [f64; 2])> {
        let mut near = Vec::new();
        for strand in hair.strands().filter_map(|strand| self.felt(strand)) {
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            for (p, r) in strand.points.iter().zip(strand.radii) {
                for axis in 0..2 {
                    low[axis] = low[axis].min(f64::from(p[axis] - r) - margin);
                    high[axis] = high[axis].max(f64::from(p[axis] + r) + margin);
                }
            }
            for i in (low[0] - place[0]).ceil() as i32..=(high[0] - place[0]).floor() as i32 {
                for j in (low[1] - place[1]).ceil() as i32..=(high[1] - place[1]).floor() as i32 {
                    near.push((strand, [f64::from(i), f64::from(j)]));
                }
            }
        }
        near
    }

    /// From the first to the last segment of a strand that comes so near that more than e⁻¹⁸ could be left of it.
    fn felt<'a>(&self, strand: Strand<'a>) -> Option<Strand<'a>> {
        let reach = self.core + 6.0 * self.vertical;
        let heights = |pair: &[[f32; 3]]| [pair[0][2], pair[1][2]].map(|z| f64::from(z) - self.height);
        let feels = |pair: &[[f32; 3]]| heights(pair).into_iter().any(|z| z >= -reach) && heights(pair).into_iter().any(|z| z <= reach);
        let first = strand.points.windows(2).position(feels)?;
        let last = strand.points.windows(2).rposition(feels)?;
        Some(Strand { points: &strand.points[first..last + 2], radii: &strand.radii[first..last + 2], ..strand })
    }

    /// Heights of a segment where its round section holds the place: a quadratic in the way along it.
    fn nearest_on(&self, points: &[[f32; 3]], radii: &[f32], place: [f64; 2]) -> f64 {
        let [a, b] = [points[0], points[1]].map(|p| p.map(f64::from));
        let (r, dr) = (f64::from(radii[0]), f64::from(radii[1]) - f64::from(radii[0]));
        let (p, d) = ([a[0] - place[0], a[1] - place[1]], [b[0] - a[0], b[1] - a[1]]);
        let qa = d[0] * d[0] + d[1] * d[1] - dr * dr;
        let qb = p[0] * d[0] + p[1] * d[1] - r * dr;
        let qc = p[0] * p[0] + p[1] * p[1] - r * r;
        let inside = |t: f64| qa * t * t + 2.0 * qb * t + qc <= 0.0;
        let root = (qb * qb - qa * qc).max(0.0).sqrt();
        let mut ends: Vec<f64> = [0.0, 1.0, (-qb - root) / qa, (-qb + root) / qa].into_iter().filter(|t| (0.0..=1.0).contains(t)).collect();
        ends.sort_by(f64::total_cmp);
        if ends.len() == 2 && !inside(0.5) {
            return f64::INFINITY;
        }
        let depth = |t: f64| a[2] + (b[2] - a[2]) * t - self.height;
        let mut best = f64::INFINITY;
        for pair in ends.windows(2).filter(|pair| inside(0.5 * (pair[0] + pair[1]))) {
            let (h0, h1) = (depth(pair[0]), depth(pair[1]));
            best = best.min(if h0 * h1 <= 0.0 { 0.0 } else { h0.abs().min(h1.abs()) });
        }
        best
    }
}

/// Roberts' R4 sequence: powers of the reciprocal of the root of x⁵ = x + 1.
fn sequence(number: u32) -> [f64; 4] {
    let n = f64::from(number) + 1.0;
    [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_808_7, 0.538_597_257_223_610_1].map(|step| (0.5 + n * step).fract())
}
