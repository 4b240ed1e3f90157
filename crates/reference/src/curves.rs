//! The strands as curves, for other ray tracers to check us.

use std::io::{self, Write};

use crate::lay::{Edges, Laid, lay};
use crate::{ReferenceError, Scene};

/// Hair as curves: of each its places and radii from root to tip, `[x, y, z, radius]`, in coat coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curves(pub Vec<Vec<[f32; 4]>>);

impl Curves {
    /// Writes them as text: `x y z radius` a line, a blank line between curves.
    ///
    /// # Errors
    /// What the writer says.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        for (number, curve) in self.0.iter().enumerate() {
            if number > 0 {
                writeln!(out)?;
            }
            for [x, y, z, radius] in curve {
                writeln!(out, "{x} {y} {z} {radius}")?;
            }
        }
        out.flush()
    }

    /// Bytes of all points.
    pub fn byte_size(&self) -> usize {
        self.0.iter().map(|curve| size_of_val(&curve[..])).sum()
    }
}

impl Scene<'_> {
    /// Every hair as laid. One that an outline cuts, or that leaves a patch and comes back, is several curves, cut where its axis is.
    ///
    /// # Errors
    /// As [`Scene::new`]: hair in shell space is laid once more, as rays want it whole at the edges of faces.
    pub fn curves(&self) -> Result<Curves, ReferenceError> {
        let laid = lay(self.skin.coat, self.tile, &self.laying, Edges::Axes)?;
        let mut order: Vec<u32> = (0..laid.origins.len() as u32).filter(|&number| self.is_there(&laid, number)).collect();
        let key = |number: u32| {
            let origin = &laid.origins[number as usize];
            (origin.copy, origin.strand, origin.along[0].to_bits(), number)
        };
        order.sort_unstable_by_key(|&number| key(number));
        let mut curves: Vec<Vec<[f32; 4]>> = Vec::new();
        let mut last: Option<u32> = None;
        for number in order {
            let segment = &laid.segments[number as usize];
            let [from, to] = [0, 1].map(|k| [segment.ends[k][0], segment.ends[k][1], segment.ends[k][2], segment.radii[k]]);
            match curves.last_mut().filter(|_| last.is_some_and(|last| goes_on(&laid, last, number))) {
                Some(curve) => curve.push(to),
                None => curves.push(vec![from, to]),
            }
            last = Some(number);
        }
        Ok(Curves(curves))
    }
}

impl Scene<'_> {
    /// Whether the middle of a segment stands, where coats become each other.
    fn is_there(&self, laid: &Laid, number: u32) -> bool {
        let origin = &laid.origins[number as usize];
        self.stands(origin.strand, self.skin.mix(origin.face as usize, origin.beta_at(0.5)))
    }
}

/// Whether one segment begins where another ends: the same hair, and the same place but for rounding.
fn goes_on(laid: &Laid, before: u32, after: u32) -> bool {
    let [a, b] = [before, after].map(|number| &laid.origins[number as usize]);
    let [end, start] = [laid.segments[before as usize].axis()[1], laid.segments[after as usize].axis()[0]];
    let radius = f64::from(laid.segments[before as usize].radii[1]);
    (a.copy, a.strand) == (b.copy, b.strand) && end.distance(start) <= 1e-6 * (1.0 + end.length()) + 1e-3 * radius
}
