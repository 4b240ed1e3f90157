//! How the strands of a tile lie on the whole: what the per-vertex hair direction *T* is made from.

use glam::{DVec3, Vec3};
use pelage_strand::StrandTile;

use super::curve::Curve;

/// Into so many layers the height is cut, to know the mean of hair that is cut off.
const LAYERS: usize = 64;

/// The hair's directions up to any height, in the frame of *s*, *t* and the hair's own way up.
#[derive(Clone, Debug)]
pub(crate) struct Lean {
    /// Of each coat of a row.
    coats: Vec<CoatLean>,
}

/// Those of one coat.
#[derive(Clone, Debug)]
struct CoatLean {
    whole: Sum,
    /// Of all hair under each layer, the last of all.
    under: Vec<Sum>,
}

/// A weighted sum of unit directions.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    /// Along *s*, *t* and the mean way up.
    direction: DVec3,
    /// What bending adds to the way up: the sum of the heights' distances from the middle, −1 to 1.
    bending: f64,
    weight: f64,
}

impl Lean {
    /// Of a tile laid with a side of `tile_side` and its height stretched to `length` along `curve`, both in diameters.
    /// Without strands hair stands as the fur does.
    pub(crate) fn of(strands: Option<&StrandTile>, tile_side: f64, length: f64, curve: &Curve) -> Self {
        let Some(strands) = strands else { return Self { coats: vec![CoatLean::upright()] } };
        let laid = |coat: u32| CoatLean::of(strands, coat, (tile_side, length), curve);
        Self { coats: (0..strands.coats()).map(laid).collect() }
    }
}

impl CoatLean {
    fn upright() -> Self {
        Self { whole: Sum::default(), under: vec![Sum::default(); LAYERS + 1] }
    }

    fn of(strands: &StrandTile, coat: u32, (tile_side, length): (f64, f64), curve: &Curve) -> Self {
        let tile_height = strands.height().max(f64::MIN_POSITIVE);
        let stretch = DVec3::new(tile_side, tile_side, length / tile_height);
        let mut whole = Sum::default();
        let mut layers = vec![Sum::default(); LAYERS];
        for strand in strands.strands().filter(|strand| strand.stands_at(f64::from(coat))) {
            for step in strand.points.windows(2) {
                let [from, to] = [step[0], step[1]].map(Vec3::from);
                let height = (0.5 * f64::from(from.z + to.z) / tile_height).clamp(0.0, 1.0);
                let part = Sum::of_step((to - from).as_dvec3(), stretch, height, curve.speed(height));
                whole.add(&part);
                layers[((height * LAYERS as f64) as usize).min(LAYERS - 1)].add(&part);
            }
        }
        let mut under = vec![Sum::default()];
        for layer in &layers {
            let mut next = under[under.len() - 1];
            next.add(layer);
            under.push(next);
        }
        Self { whole, under }
    }

    fn up_to(&self, end: f64) -> Sum {
        if end >= 1.0 {
            return self.whole;
        }
        let place = end * LAYERS as f64;
        let layer = (place as usize).min(LAYERS - 1);
        self.under[layer].lerp(&self.under[layer + 1], place - layer as f64)
    }
}

impl Lean {
    /// *T* of hair cut off at height `end`, 1 for whole hair: its mean direction, carried to the surface by the tile's axes: *s* and *t* in the tangent plane,
    /// height along the hair, whose derivative `curve` gives as *c* and *b* (L14).
    ///
    /// The mean of directions that differ is shorter than 1, and is kept so: lit by it, hair that stands every which way has no dark spot where it would
    /// point at the light if it all stood one way. Without a field the tile lies in another direction on each patch, and only the height counts.
    ///
    /// `coat` is the place in the row of coats: between two, hair of either counts by its share, as so much of it stands.
    pub(crate) fn direction(&self, (coat, end): (f64, f64), (normal, along): (DVec3, DVec3), (c, b): (DVec3, DVec3)) -> DVec3 {
        let mean = self.between(coat, end).mean();
        let across = along.cross(normal);
        across * mean.direction.x + along * mean.direction.y + c * mean.direction.z + b * mean.bending
    }

    fn between(&self, coat: f64, end: f64) -> Sum {
        let last = self.coats.len() - 1;
        let before = (coat.max(0.0) as usize).min(last);
        let sum = self.coats[before].up_to(end);
        if before == last { sum } else { sum.lerp(&self.coats[before + 1].up_to(end), coat - before as f64) }
    }
}

impl Sum {
    /// Of one step of a strand at `height`, where the hair runs up with `speed`. Its weight is its length in the tile, which no stretch makes zero.
    fn of_step(run: DVec3, stretch: DVec3, height: f64, speed: f64) -> Self {
        let weight = run.length();
        let laid = run * stretch * DVec3::new(1.0, 1.0, speed);
        let unit = laid.normalize_or(DVec3::Z);
        // The way up is the derivative over its size: (c + b (2h − 1)) / speed.
        let up = weight * unit.z / speed;
        Self { direction: DVec3::new(weight * unit.x, weight * unit.y, up), bending: up * (2.0 * height - 1.0), weight }
    }

    fn add(&mut self, part: &Self) {
        self.direction += part.direction;
        self.bending += part.bending;
        self.weight += part.weight;
    }

    fn lerp(&self, other: &Self, t: f64) -> Self {
        Self {
            direction: self.direction.lerp(other.direction, t),
            bending: self.bending + (other.bending - self.bending) * t,
            weight: self.weight + (other.weight - self.weight) * t,
        }
    }

    /// Divided by its weight; of no hair, upright.
    fn mean(self) -> Self {
        if self.weight > 0.0 {
            Self { direction: self.direction / self.weight, bending: self.bending / self.weight, weight: 1.0 }
        } else {
            Self { direction: DVec3::Z, bending: 0.0, weight: 0.0 }
        }
    }
}
