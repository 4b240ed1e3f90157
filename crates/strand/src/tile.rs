//! The grown hair: strands in structure-of-arrays.

use crate::blend::EVERYWHERE;
use crate::colour::{Bands, Opacity, Tint, shaded};
use crate::error::StrandError;

/// How far from the origin a hand-made strand may have its root, in tile sides.
pub const MAX_TILES_AWAY: f64 = 1e6;

/// Where a strand stands on the endless plane of tiles: which tile, and where in it.
///
/// Kept apart so that moving by whole tiles changes no bit of what is inside the tile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Root {
    /// Which tile, along x (s) and y (t).
    pub cell: [i32; 2],
    /// Where in it, each in [0, 1).
    pub fraction: [f32; 2],
}

impl Root {
    /// The root at a place given in tile sides; `None` where that is not finite or further than [`MAX_TILES_AWAY`].
    pub fn new(x: f64, y: f64) -> Option<Self> {
        let (x, y) = (split(x)?, split(y)?);
        Some(Self { cell: [x.0, y.0], fraction: [x.1, y.1] })
    }

    /// The same root `tiles` further; the fraction keeps its bits, the cell stops at the ends of `i32`.
    pub fn moved(self, tiles: [i32; 2]) -> Self {
        Self { cell: [self.cell[0].saturating_add(tiles[0]), self.cell[1].saturating_add(tiles[1])], ..self }
    }
}

/// Integer and fraction of one coordinate, the fraction in [0, 1) also after rounding to `f32`.
fn split(value: f64) -> Option<(i32, f32)> {
    if !value.is_finite() || value.abs() > MAX_TILES_AWAY {
        return None;
    }
    let cell = value.floor();
    let fraction = (value - cell) as f32;
    Some(if fraction < 1.0 { (cell as i32, fraction) } else { (cell as i32 + 1, 0.0) })
}

/// A hand-made strand, to be put into a tile with [`StrandTile::from_strands`].
#[derive(Clone, Debug, PartialEq)]
pub struct StrandSource {
    /// From root to tip, in tile sides; may lie anywhere on the plane of tiles.
    pub points: Vec<[f64; 3]>,
    /// Half the hair's width at each point, in tile sides.
    pub radii: Vec<f64>,
    /// Linear RGB at the root.
    pub root_colour: [f32; 3],
    /// Linear RGB at the tip.
    pub tip_colour: [f32; 3],
}

/// A box of hair, one tile side square and `height` high, toroidal along x and y.
///
/// x runs along s, y along t (the way the fur lies), z up from the skin, all in tile sides. Points of a strand are unwrapped: they may leave
/// the tile, its root lies inside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StrandTile {
    pub(crate) height: f64,
    pub(crate) offsets: Vec<u32>,
    pub(crate) points: Vec<[f32; 3]>,
    pub(crate) radii: Vec<f32>,
    pub(crate) root_colours: Vec<[f32; 3]>,
    pub(crate) tip_colours: Vec<[f32; 3]>,
    pub(crate) cells: Vec<[i32; 2]>,
    /// Where each population ends: of each, every beginning stands evenly.
    populations: Vec<u32>,
    /// Colours that some strands share.
    bands: Vec<Bands>,
    /// One a strand; empty where all are of two colours and opaque.
    tints: Vec<Tint>,
    /// From where and up to where in the row of coats each stands.
    pub(crate) stands: Vec<[f32; 2]>,
    /// How many coats follow the first.
    pub(crate) transitions: u32,
}

/// One strand of a tile, borrowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strand<'a> {
    /// From root to tip in tile sides, relative to the strand's own tile: the root lies in [0, 1)².
    pub points: &'a [[f32; 3]],
    /// Half the hair's width at each point, in tile sides.
    pub radii: &'a [f32],
    /// Linear RGB at the root.
    pub root_colour: [f32; 3],
    /// Linear RGB at the tip.
    pub tip_colour: [f32; 3],
    /// Which tile the root stands in; [0, 0] for grown hair.
    pub cell: [i32; 2],
    /// How opaque it is at the root and at the tip, 0 to 1.
    pub opacity: [f32; 2],
    /// Its colours along the way, where it has more than two; [`Strand::colour_at`] reads them.
    pub bands: Option<&'a Bands>,
    /// What those are multiplied by.
    pub shade: f32,
    /// From where (included) up to where (not) in the row of coats it stands: [−∞, ∞] for hair of one coat. See [`StrandTile::row`].
    pub stands: [f32; 2],
}

impl StrandTile {
    /// A box `height` tile sides high without hair.
    pub fn empty(height: f64) -> Self {
        Self { height, offsets: vec![0], ..Self::default() }
    }

    /// A box `height` tile sides high with strands made elsewhere.
    ///
    /// # Errors
    /// A height that is not finite and positive, a strand with fewer than two points, radii that do not match, values that are not finite.
    pub fn from_strands(height: f64, sources: &[StrandSource]) -> Result<Self, StrandError> {
        if !(height.is_finite() && height > 0.0) {
            return Err(StrandError::OutOfRange {
                name: "height",
                value: height,
                low: f64::MIN_POSITIVE,
                high: f64::MAX,
                unit: "tile sides",
            });
        }
        let mut tile = Self::empty(height);
        for (strand, source) in sources.iter().enumerate() {
            check_source(strand, source)?;
            let bad = |point| StrandError::BadPoint { strand, point, limit: MAX_TILES_AWAY };
            let [x, y, _] = source.points[0];
            let root = Root::new(x, y).ok_or(bad(0))?;
            // In f64, so that a strand a thousand tiles away loses nothing before it is brought home.
            let home = root.cell.map(f64::from);
            let points = source.points.iter().map(|p| [(p[0] - home[0]) as f32, (p[1] - home[1]) as f32, p[2] as f32]);
            // The root is the rounded fraction, which a cell's edge may have carried over.
            let points = points.enumerate().map(|(i, p)| if i == 0 { [root.fraction[0], root.fraction[1], p[2]] } else { p });
            tile.push(root.cell, points, source.radii.iter().map(|&r| r as f32), source.root_colour, source.tip_colour);
        }
        tile.set_populations(&[sources.len() as u32]);
        Ok(tile)
    }

    /// The same hair, all of it as opaque as said, and of these colours; without bands of its two colours at root and tip.
    ///
    /// # Errors
    /// An opacity that is not within 0 to 1.
    pub fn tinted(mut self, bands: Bands, opacity: &Opacity) -> Result<Self, StrandError> {
        opacity.validate()?;
        let tint = Tint {
            bands: if bands.is_empty() { u32::MAX } else { 0 },
            shade: 1.0,
            opacity: [opacity.root, opacity.tip].map(|opacity| opacity as f32),
        };
        self.tint(bands, vec![tint; self.strand_count()]);
        Ok(self)
    }

    /// Gives each strand its tint; of bands there are these only.
    pub(crate) fn tint(&mut self, bands: Bands, tints: Vec<Tint>) {
        for (strand, tint) in tints.iter().enumerate().filter(|(_, tint)| tint.bands == 0) {
            self.root_colours[strand] = shaded(bands.at(0.0), tint.shade);
            self.tip_colours[strand] = shaded(bands.at(1.0), tint.shade);
        }
        self.bands = vec![bands];
        self.tints = tints;
    }

    /// Says how many strands each population has, in order.
    pub(crate) fn set_populations(&mut self, counts: &[u32]) {
        let ends = counts.iter().scan(0, |end, count| {
            *end += count;
            Some(*end)
        });
        self.populations = ends.collect();
    }

    /// The strands of each population in order, by number: of each, every beginning stands evenly.
    pub(crate) fn populations(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let mut from = 0;
        self.populations.iter().map(move |&end| std::mem::replace(&mut from, end as usize)..end as usize)
    }

    /// Appends a strand of another tile as it is.
    pub(crate) fn push_strand(&mut self, strand: &Strand<'_>) {
        let tint = self.tint_of(strand);
        if tint != Tint::PLAIN && self.tints.is_empty() {
            self.tints = vec![Tint::PLAIN; self.strand_count()];
        }
        if tint != Tint::PLAIN || !self.tints.is_empty() {
            self.tints.push(tint);
        }
        self.push(strand.cell, strand.points.iter().copied(), strand.radii.iter().copied(), strand.root_colour, strand.tip_colour);
    }

    /// What a strand is tinted by here, its bands taken in if they are new.
    fn tint_of(&mut self, strand: &Strand<'_>) -> Tint {
        let bands = strand.bands.map_or(u32::MAX, |bands| {
            let known = self.bands.iter().position(|known| known == bands).unwrap_or(self.bands.len());
            if known == self.bands.len() {
                self.bands.push(*bands);
            }
            known as u32
        });
        Tint { bands, shade: strand.shade, opacity: strand.opacity }
    }

    /// Appends one strand whose points are already relative to its cell.
    pub(crate) fn push(
        &mut self,
        cell: [i32; 2],
        points: impl Iterator<Item = [f32; 3]>,
        radii: impl Iterator<Item = f32>,
        root_colour: [f32; 3],
        tip_colour: [f32; 3],
    ) {
        self.points.extend(points);
        self.radii.extend(radii);
        self.offsets.push(self.points.len() as u32);
        self.root_colours.push(root_colour);
        self.tip_colours.push(tip_colour);
        self.cells.push(cell);
        self.stands.push(EVERYWHERE);
    }

    /// Appends a strand of another tile, its height times `stretch`, standing where `stands` says.
    pub(crate) fn copy(&mut self, other: &Self, index: usize, stretch: f64, stands: [f32; 2]) {
        let Some(strand) = other.strand(index) else { return };
        let points: Vec<[f32; 3]> = strand.points.iter().map(|p| [p[0], p[1], (f64::from(p[2]) * stretch) as f32]).collect();
        self.push_strand(&Strand { points: &points, ..strand });
        if let Some(last) = self.stands.last_mut() {
            *last = stands;
        }
    }

    /// How high the box is, in tile sides: no grown point is higher.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// How many strands there are.
    pub fn strand_count(&self) -> usize {
        self.cells.len()
    }

    /// How many points all strands have together.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Strand number `index`, or `None` beyond the last.
    pub fn strand(&self, index: usize) -> Option<Strand<'_>> {
        let range = *self.offsets.get(index)? as usize..*self.offsets.get(index + 1)? as usize;
        let tint = self.tints.get(index).copied().unwrap_or(Tint::PLAIN);
        Some(Strand {
            points: self.points.get(range.clone())?,
            radii: self.radii.get(range)?,
            root_colour: *self.root_colours.get(index)?,
            tip_colour: *self.tip_colours.get(index)?,
            cell: *self.cells.get(index)?,
            opacity: tint.opacity,
            bands: self.bands.get(tint.bands as usize),
            shade: tint.shade,
            stands: *self.stands.get(index)?,
        })
    }

    /// All strands in order; guard hairs come before the undercoat, the first tile of a mix before the second.
    pub fn strands(&self) -> impl Iterator<Item = Strand<'_>> {
        (0..self.strand_count()).filter_map(|index| self.strand(index))
    }

    /// Whether no hair lets light through.
    pub fn is_opaque(&self) -> bool {
        self.tints.iter().all(|tint| tint.opacity == [1.0; 2])
    }

    /// The same hair with every strand moved by whole tiles: the torus does not tell the two apart, and neither does any bit of the points.
    pub fn moved(&self, tiles: [i32; 2]) -> Self {
        let mut moved = self.clone();
        for cell in &mut moved.cells {
            *cell = [cell[0].saturating_add(tiles[0]), cell[1].saturating_add(tiles[1])];
        }
        moved
    }

    /// Bytes of all arrays.
    pub fn byte_size(&self) -> usize {
        size_of_val(&self.offsets[..])
            + size_of_val(&self.points[..])
            + size_of_val(&self.radii[..])
            + size_of_val(&self.root_colours[..])
            + size_of_val(&self.tip_colours[..])
            + size_of_val(&self.cells[..])
            + size_of_val(&self.populations[..])
            + size_of_val(&self.bands[..])
            + size_of_val(&self.tints[..])
            + size_of_val(&self.stands[..])
    }
}

impl Strand<'_> {
    /// Whether it stands at a place in the row of coats.
    pub fn stands_at(&self, place: f64) -> bool {
        let [from, to] = self.stands.map(f64::from);
        from <= place && place < to
    }

    /// Point number `index` on the endless plane of tiles, in tile sides; `None` beyond the tip.
    pub fn plane_point(&self, index: usize) -> Option<[f64; 3]> {
        let p = self.points.get(index)?.map(f64::from);
        Some([p[0] + f64::from(self.cell[0]), p[1] + f64::from(self.cell[1]), p[2]])
    }

    /// Length along the hair, in tile sides.
    pub fn arc_length(&self) -> f64 {
        let step = |pair: &[[f32; 3]]| {
            let d = [0, 1, 2].map(|axis| f64::from(pair[1][axis]) - f64::from(pair[0][axis]));
            (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
        };
        self.points.windows(2).map(step).sum()
    }
}

/// Refuses what the samplers could not live with.
fn check_source(strand: usize, source: &StrandSource) -> Result<(), StrandError> {
    let points = source.points.len();
    if points < 2 {
        return Err(StrandError::TooShort { strand, points });
    }
    if source.radii.len() != points {
        return Err(StrandError::RadiiMismatch { strand, points, radii: source.radii.len() });
    }
    let usable = |p: &[f64; 3]| p.iter().all(|c| c.is_finite() && c.abs() <= MAX_TILES_AWAY);
    let fit = |r: &f64| r.is_finite() && *r >= 0.0 && *r <= MAX_TILES_AWAY;
    let colours = source.root_colour.iter().chain(&source.tip_colour).all(|c| c.is_finite());
    let wrong = (0..points).find(|&i| !usable(&source.points[i]) || !fit(&source.radii[i]) || (i == 0 && !colours));
    wrong.map_or(Ok(()), |point| Err(StrandError::BadPoint { strand, point, limit: MAX_TILES_AWAY }))
}
