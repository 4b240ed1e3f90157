//! Combing by hand: strokes as data of the graph (L21, N4, L25).

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Frame};
use pelage_field::{Brush, BrushStroke, Comb, DirectionField, ScalarField, Tool};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::{Mesh, Ray, SpatialIndex};

use crate::Framing;

/// What is in the hand.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum CombTool {
    /// Leans the fur further.
    Comb {
        /// Which way; its part along the surface counts. Zero: as the hand drags over the picture.
        #[param(default = [0.0, 0.0, 0.0], unit = "direction")]
        toward: [f64; 3],
        /// How much further.
        #[param(default = 30.0, range = 0.0..=80.0, unit = "degrees", effect = "more: fur lies lower")]
        by: f64,
    },
    /// Leans the fur along the stroke.
    Along {
        /// How far.
        #[param(default = 45.0, range = -80.0..=80.0, unit = "degrees from upright", effect = "more: fur lies lower")]
        slant: f64,
    },
    /// Makes neighbours lie alike.
    Smooth,
    /// Lays the fur away from the stroke on both sides.
    Part {
        /// How far.
        #[param(default = 50.0, range = -80.0..=80.0, unit = "degrees from upright", effect = "more: fur lies lower")]
        slant: f64,
    },
    /// Lays the fur about the stroke's first place.
    Whorl {
        /// 0 is away from the place, 180 towards it, 90 around it anticlockwise seen from outside and -90 clockwise.
        #[param(default = 60.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
        turn: f64,
        /// How far down.
        #[param(default = 50.0, range = 0.0..=80.0, unit = "degrees from upright", effect = "more: fur lies lower")]
        slant: f64,
    },
    /// Stands the fur up.
    Lift,
    /// Lays the fur down the way it leans already.
    Flatten {
        /// How far.
        #[param(default = 70.0, range = 0.0..=80.0, unit = "degrees from upright", effect = "more: fur lies lower")]
        slant: f64,
    },
    /// Shortens fur that is longer.
    Cut {
        /// What is left.
        #[param(default = 0.3, range = 0.0..=1.0, unit = "fraction of the length", effect = "0 is bare")]
        to: f64,
    },
    /// Makes the fur longer, and stands it up.
    Puff {
        /// By how much.
        #[param(default = 0.3, range = 0.0..=10.0, unit = "fraction of the length", effect = "longer fur")]
        by: f64,
    },
}

/// Where a stroke goes.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum StrokePath {
    /// Over places of the surface, each brought to the nearest point of it; one place is a dab.
    Surface {
        /// The places.
        #[param(default = Vec::new(), unit = "model units")]
        path: Vec<[f64; 3]>,
    },
    /// A circle on a picture of the skin, dragged in the view plane: what is seen under it. Of a `Camera` it takes what that has.
    Screen {
        /// Around the vertical axis, anticlockwise seen from above; 0 looks along -z.
        #[param(default = 0.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
        azimuth: f64,
        /// Above the horizon.
        #[param(default = 15.0, range = -90.0..=90.0, unit = "degrees", effect = "none on cost")]
        elevation: f64,
        /// How far back to stand.
        #[param(default = 0.85, range = 0.01..=1000.0, unit = "ratio", effect = "none on cost")]
        margin: f64,
        /// Where the circle is put down: right and up from the middle.
        #[param(default = [0.0, 0.0], unit = "picture heights")]
        from: [f64; 2],
        /// Where it is dragged to.
        #[param(default = [0.1, 0.0], unit = "picture heights")]
        to: [f64; 2],
    },
}

/// One stroke of a tool.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct CombStroke {
    /// What is in the hand.
    #[param(default = CombTool::Comb { toward: [0.0, 0.0, 0.0], by: 30.0 })]
    pub tool: CombTool,
    /// Where it goes.
    #[param(default = StrokePath::Surface { path: Vec::new() })]
    pub over: StrokePath,
    /// How far along the surface it reaches; it fades out towards there.
    #[param(default = 0.08, range = 0.0001..=10.0, unit = "model diameters", effect = "wider strokes touch more vertices, and cost as much more")]
    pub radius: f64,
    /// How strongly.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "fraction", effect = "1: fur under its middle does as it is told")]
    pub strength: f64,
}

/// Fur combed by hand: strokes in their order, each over what the ones before have left (L21).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(directions: DirectionField, "Which way the fur lies; where it stands up, as its surroundings do.")]
#[output(slants: ScalarField, "How far it leans, in degrees from upright.")]
#[output(lengths: ScalarField, "Factors of the length.")]
pub struct CombStrokes {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// Which way the fur lies before; without, it stands up.
    #[input]
    pub directions: Option<Arc<DirectionField>>,
    /// Factors of the length before.
    #[input]
    pub lengths: Option<Arc<ScalarField>>,
    /// How far it leans before.
    #[param(default = 30.0, range = -80.0..=80.0, unit = "degrees from upright", effect = "past 45 layers no longer hide each other's gaps")]
    pub slant: f64,
    /// What all of it leans further before the first stroke, as in a wind; its length counts (N4).
    #[param(default = [0.0, 0.0, 0.0], unit = "degrees")]
    pub everywhere: [f64; 3],
    /// The strokes.
    #[param(default = Vec::new())]
    pub strokes: Vec<CombStroke>,
}

impl Evaluate for CombStrokes {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let mesh = &*self.mesh;
        let mut comb = Comb::new(mesh, self.directions.as_deref(), self.slant.to_radians())?;
        let everywhere = DVec3::from(self.everywhere).map(f64::to_radians);
        if everywhere != DVec3::ZERO {
            comb.add(mesh, everywhere)?;
        }
        if !self.strokes.is_empty() {
            let (mut brush, index) = (Brush::on(mesh), SpatialIndex::of(mesh));
            for (number, stroke) in self.strokes.iter().enumerate() {
                let named = |error: NodeError| NodeError::from(format!("strokes[{number}]: {error}"));
                let stroke = stroke.on(&index).map_err(named)?;
                brush.apply(&stroke, &mut comb).map_err(|error| named(error.into()))?;
            }
        }
        let lengths = comb.lengths()?;
        let lengths = match &self.lengths {
            Some(before) => before.times(&lengths)?,
            None => lengths,
        };
        Ok(CombStrokesOutputs {
            directions: Some(Arc::new(comb.directions(mesh)?)),
            slants: Some(Arc::new(comb.slants()?.map(f32::to_degrees)?)),
            lengths: Some(Arc::new(lengths)),
        })
    }
}

impl CombStroke {
    /// The stroke on a surface.
    fn on(&self, index: &SpatialIndex<'_>) -> Result<BrushStroke, NodeError> {
        let (path, drag) = match &self.over {
            StrokePath::Surface { path } => (path.iter().map(|&place| DVec3::from(place)).collect(), DVec3::ZERO),
            &StrokePath::Screen { azimuth, elevation, margin, from, to } => {
                let picture = Picture::of(index.mesh(), azimuth, elevation, margin);
                // A drag in the view plane leans what is under the circle; other tools go where it goes.
                let places = if matches!(self.tool, CombTool::Comb { .. }) { vec![from] } else { vec![from, to] };
                (places.into_iter().map(|place| picture.pick(index, place)).collect::<Result<_, _>>()?, picture.drag(from, to))
            }
        };
        Ok(BrushStroke { tool: self.tool.with(drag), path, radius: self.radius, strength: self.strength })
    }
}

impl CombTool {
    /// The tool, where the hand drags `drag` in the view plane.
    fn with(&self, drag: DVec3) -> Tool {
        match *self {
            Self::Comb { toward, by } => {
                let toward = DVec3::from(toward);
                Tool::Comb { toward: if toward == DVec3::ZERO { drag } else { toward }.normalize_or_zero() * by.to_radians() }
            }
            Self::Along { slant } => Tool::Along { slant: slant.to_radians() },
            Self::Smooth => Tool::Smooth,
            Self::Part { slant } => Tool::Part { slant: slant.to_radians() },
            Self::Whorl { turn, slant } => Tool::Whorl { turn: turn.to_radians(), slant: slant.to_radians() },
            Self::Lift => Tool::Lift,
            Self::Flatten { slant } => Tool::Flatten { slant: slant.to_radians() },
            Self::Cut { to } => Tool::Cut { to },
            Self::Puff { by } => Tool::Puff { by },
        }
    }
}

/// The vertical angle of view, as a `Camera` has it by default.
const FIELD_OF_VIEW: f32 = 30.0;

/// A picture of the skin, in model coordinates.
struct Picture {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Half the picture's height, one unit before the eye.
    half_height: f64,
}

impl Picture {
    fn of(mesh: &Mesh, azimuth: f64, elevation: f64, margin: f64) -> Self {
        let (low, high) = mesh.bounds().unwrap_or_default();
        let frame = Frame { centre: 0.5 * (low + high), diameter: if mesh.diameter() > 0.0 { mesh.diameter() } else { 1.0 } };
        let framing = Framing {
            azimuth: azimuth.to_radians() as f32,
            elevation: elevation.to_radians() as f32,
            field_of_view: FIELD_OF_VIEW.to_radians(),
            margin: margin as f32,
            pan: Vec3::ZERO,
        };
        // A picture at least as wide as high frames the model by its height.
        let Camera { eye, target, up, field_of_view, .. } = framing.camera((frame.place(low), frame.place(high)), 1.0);
        let forward = (target - eye).as_dvec3().normalize_or(DVec3::NEG_Z);
        let right = forward.cross(up.as_dvec3()).normalize_or(DVec3::X);
        Self {
            eye: frame.centre + frame.diameter * eye.as_dvec3(),
            forward,
            right,
            up: right.cross(forward),
            half_height: f64::from(0.5 * field_of_view).tan(),
        }
    }

    /// A way in the view plane; its length is of no matter.
    fn drag(&self, from: [f64; 2], to: [f64; 2]) -> DVec3 {
        self.right * (to[0] - from[0]) + self.up * (to[1] - from[1])
    }

    /// What is seen at a place of the picture.
    fn pick(&self, index: &SpatialIndex<'_>, [x, y]: [f64; 2]) -> Result<DVec3, NodeError> {
        let direction = self.forward + 2.0 * self.half_height * (self.right * x + self.up * y);
        let ray = Ray::new(self.eye, direction)?;
        let hit = index
            .first_hit(&ray)
            .ok_or_else(|| format!("there is nothing of the model at ({x}, {y}) of its picture; move the stroke onto it"))?;
        Ok(ray.at(hit.distance))
    }
}
