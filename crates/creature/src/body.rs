//! The field of a whole body: its parts, joined smoothly.

use glam::DVec3;
use rayon::prelude::*;

use crate::Part;
use crate::cone::Cone;

/// One solid of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limb {
    pub(crate) cone: Cone,
    pub(crate) part: Part,
    /// How far from it, in body lengths, it begins to flow into what it is joined to.
    pub(crate) blend: f64,
}

/// The implicit surface: negative inside, zero on the skin, positive outside, never growing faster than the distance.
///
/// Limbs are joined in order by the quadratic smooth minimum (Quilez, "Smooth minimum", 2013; it goes back to Ricci's constructive geometry of 1973
/// and Bloomenthal and Shoemake's convolution surfaces of 1991): min(*a*, *b*) − *h*² *k* / 4 with *h* = max(*k* − |*a* − *b*|, 0) / *k*. Its gradient
/// is a mean of both gradients, so the whole stays 1-Lipschitz, and a limb further than *k* from what is nearer has no part in it at all.
pub(crate) struct Body {
    limbs: Vec<Limb>,
    low: DVec3,
    high: DVec3,
    lists: Lists,
}

/// For each cell of a coarse grid the limbs that have a part in the field there.
struct Lists {
    low: DVec3,
    cell: f64,
    counts: [usize; 3],
    /// `limbs[starts[c]..starts[c + 1]]` are those of cell *c*.
    starts: Vec<u32>,
    limbs: Vec<u16>,
}

/// Cells along the longest side of the coarse grid.
const LIST_CELLS: f64 = 28.0;

impl Body {
    pub(crate) fn new(limbs: Vec<Limb>) -> Self {
        let blend = limbs.iter().map(|limb| limb.blend).fold(0.0, f64::max);
        let boxes = limbs.iter().map(|limb| limb.cone.bounds());
        let (low, high) = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default();
        let (low, high) = (low - blend, high + blend);
        let lists = Lists::new(&limbs, low, high);
        Self { limbs, low, high, lists }
    }

    /// A box with some room around the surface.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        (self.low, self.high)
    }

    pub(crate) fn limbs(&self) -> &[Limb] {
        &self.limbs
    }

    /// Half the width of the thinnest limb, at its thicker end: a point that tapers away need not be resolved to be kept.
    pub(crate) fn least_thickness(&self) -> f64 {
        self.limbs.iter().map(|limb| limb.cone.greatest_thickness()).fold(f64::INFINITY, f64::min)
    }

    /// The field.
    #[inline]
    pub(crate) fn value(&self, p: DVec3) -> f64 {
        let join = |joined, &limb: &u16| {
            let limb = &self.limbs[usize::from(limb)];
            smooth_min(joined, limb.cone.value(p), limb.blend)
        };
        match self.lists.at(p) {
            Some(list) => list.iter().fold(f64::INFINITY, join),
            None => self.exact_value(p),
        }
    }

    /// The field with every limb asked.
    pub(crate) fn exact_value(&self, p: DVec3) -> f64 {
        self.limbs.iter().fold(f64::INFINITY, |joined, limb| smooth_min(joined, limb.cone.value(p), limb.blend))
    }

    /// The field and its gradient, which is at most 1 long.
    pub(crate) fn value_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let join = |joined, limb: &Limb| smooth_min_with_gradient(joined, limb.cone.value_and_gradient(p), limb.blend);
        let nothing = (f64::INFINITY, DVec3::ZERO);
        match self.lists.at(p) {
            Some(list) => list.iter().map(|&limb| &self.limbs[usize::from(limb)]).fold(nothing, join),
            None => self.limbs.iter().fold(nothing, join),
        }
    }

    /// The point of the surface that Newton's method along the gradient comes to in a few steps, none of them longer than `reach`.
    pub(crate) fn project(&self, mut p: DVec3, reach: f64, steps: u32) -> DVec3 {
        for _ in 0..steps {
            let (value, gradient) = self.value_and_gradient(p);
            let step = value * gradient / gradient.length_squared().max(1e-6);
            p -= step.clamp_length_max(reach);
            if value.abs() < 1e-14 {
                break;
            }
        }
        p
    }

    /// How thin the limb is that is nearest to a point.
    pub(crate) fn thickness(&self, p: DVec3) -> f64 {
        let nearest = |list: &mut dyn Iterator<Item = &Limb>| {
            let closer = |best: (f64, f64), limb: &Limb| {
                let value = limb.cone.value(p);
                if value < best.0 { (value, limb.cone.thickness(p)) } else { best }
            };
            list.fold((f64::INFINITY, f64::INFINITY), closer).1
        };
        match self.lists.at(p) {
            Some(list) => nearest(&mut list.iter().map(|&limb| &self.limbs[usize::from(limb)])),
            None => nearest(&mut self.limbs.iter()),
        }
    }
}

impl Lists {
    fn new(limbs: &[Limb], low: DVec3, high: DVec3) -> Self {
        let extent = high - low;
        let cell = (extent.max_element() / LIST_CELLS).max(1e-9);
        let counts = (extent / cell).to_array().map(|cells| cells.ceil().max(1.0) as usize);
        let lists: Vec<Vec<u16>> = (0..counts.iter().product())
            .into_par_iter()
            .map(|index: usize| {
                let place = [index % counts[0], index / counts[0] % counts[1], index / (counts[0] * counts[1])];
                let centre = low + cell * (DVec3::from(place.map(|k| k as f64)) + 0.5);
                // A little more than half the diagonal, for what rounding may do.
                concerned(limbs, centre, 0.867 * cell)
            })
            .collect();
        let mut starts = vec![0];
        starts.extend(lists.iter().scan(0, |end, list| {
            *end += list.len() as u32;
            Some(*end)
        }));
        Self { low, cell, counts, starts, limbs: lists.concat() }
    }

    #[inline]
    fn at(&self, p: DVec3) -> Option<&[u16]> {
        let place = ((p - self.low) / self.cell).floor();
        let inside = place.cmpge(DVec3::ZERO).all() && (0..3).all(|k| place[k] < self.counts[k] as f64);
        inside.then(|| {
            let [x, y, z] = place.to_array().map(|k| k as usize);
            let cell = x + self.counts[0] * (y + self.counts[1] * z);
            &self.limbs[self.starts[cell] as usize..self.starts[cell + 1] as usize]
        })
    }
}

/// The limbs that have a part in the field somewhere within `radius` of a place: each join is made with the bounds of both sides (Duff, "Interval
/// arithmetic and recursive subdivision for implicit functions and constructive solid geometry", 1992). What a limb leaves as it is, it is left out of; what it
/// replaces altogether is forgotten.
fn concerned(limbs: &[Limb], centre: DVec3, radius: f64) -> Vec<u16> {
    let (mut least, mut most) = (f64::INFINITY, f64::INFINITY);
    let mut list = Vec::new();
    for (index, limb) in limbs.iter().enumerate() {
        let value = limb.cone.value(centre);
        let (low, high) = (value - radius, value + radius);
        if low >= most + limb.blend {
            continue;
        }
        if least >= high + limb.blend {
            list.clear();
        }
        list.push(index as u16);
        (least, most) = (smooth_min(least, low, limb.blend), smooth_min(most, high, limb.blend));
    }
    list
}

#[inline]
fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - 0.25 * k * h * h
}

#[inline]
fn smooth_min_with_gradient(a: (f64, DVec3), b: (f64, DVec3), k: f64) -> (f64, DVec3) {
    let h = (k - (a.0 - b.0).abs()).max(0.0) / k;
    let (near, far) = if b.0 < a.0 { (b, a) } else { (a, b) };
    (near.0 - 0.25 * k * h * h, near.1 + (far.1 - near.1) * (0.5 * h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Species, anatomy};

    /// Bit for bit: what a cell leaves out has no part in the field there.
    #[test]
    fn the_lists_leave_out_nothing_that_matters() {
        for species in Species::ALL {
            let body = Body::new(anatomy::limbs(&species.plan()));
            let (low, high) = body.bounds();
            let place = |k: u32| low + (high - low) * ((f64::from(k) * DVec3::new(0.819_173, 0.671_044, 0.549_7)) % 1.0);
            for p in (0..20_000).map(place) {
                assert_eq!(body.value(p).to_bits(), body.exact_value(p).to_bits(), "{} at {p}", species.name());
                assert_eq!(body.value(p).to_bits(), body.value_and_gradient(p).0.to_bits());
            }
        }
    }

    #[test]
    fn joints_are_smooth_and_reach_no_further_than_the_blend() {
        assert_eq!(smooth_min(0.3, 0.5, 0.1), 0.3);
        assert_eq!(smooth_min(0.5, 0.3, 0.1), 0.3);
        assert_eq!(smooth_min(0.3, 0.3, 0.1), 0.3 - 0.025);
        let slope = |a: f64| (smooth_min(a + 1e-6, 0.3, 0.1) - smooth_min(a - 1e-6, 0.3, 0.1)) / 2e-6;
        assert!((slope(0.3) - 0.5).abs() < 1e-4 && slope(0.399_9).abs() < 1e-2 && (slope(0.200_1) - 1.0).abs() < 1e-2);
    }
}
