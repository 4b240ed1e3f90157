//! Fields on the surface.

use std::sync::Arc;

use glam::DVec3;
use pelage_field::{ColourField, Constraint, DirectionField, Flow, PointConstraint, ScalarField};
use pelage_graph::{Colour, Context, Evaluate, FilePath, Node, NodeError, Param};
use pelage_mesh::Mesh;

use crate::shading::linear;

/// A place and the way the fur lies there.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct DirectionConstraint {
    /// The place; the nearest vertex holds the constraint.
    #[param(default = [0.0, 0.0, 0.0], unit = "model units")]
    pub at: [f64; 3],
    /// The way the fur lies there; its part along the normal is left out.
    #[param(default = [0.0, -1.0, 0.0], unit = "direction")]
    pub along: [f64; 3],
}

/// How the fur lies about a place.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum PointFlow {
    /// Turned from straight away: a source, a sink, a whirl or a spiral.
    Turned {
        /// 0 is away from the place, 180 towards it, 90 around it anticlockwise seen from outside and -90 clockwise; between them are spirals.
        #[param(default = 0.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
        turn: f64,
    },
    /// A saddle: the fur comes from two sides and leaves to two others.
    Saddle {
        /// One of the two ways in which it leaves; its part along the normal is left out.
        #[param(default = [1.0, 0.0, 0.0], unit = "direction")]
        along: [f64; 3],
    },
}

/// A place that the fur lies about: a cowlick, a crown, a swirl (L25).
#[derive(Clone, Debug, PartialEq, Param)]
pub struct DirectionPoint {
    /// The place; the nearest face holds the singularity.
    #[param(default = [0.0, 0.0, 0.0], unit = "model units")]
    pub at: [f64; 3],
    /// How the fur lies about it.
    #[param(default = PointFlow::Turned { turn: 0.0 })]
    pub flow: PointFlow,
}

/// A tangent direction at each vertex: which way the fur lies (L2).
#[derive(Node)]
#[node(category = "Fields", version = 2, name = "DirectionField")]
#[output(directions: DirectionField, "A unit tangent for each vertex.")]
pub struct DirectionFieldNode {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// One direction for the whole surface, projected onto it; used where there are neither constraints nor points.
    #[param(default = [0.0, -0.3, -1.0], unit = "direction")]
    pub toward: [f64; 3],
    /// Places where the direction is given; it spreads from them over the surface.
    #[param(default = Vec::new())]
    pub constraints: Vec<DirectionConstraint>,
    /// Places that the fur runs away from, towards or around; each is met, and blended with the constraints.
    #[param(default = Vec::new())]
    pub points: Vec<DirectionPoint>,
    /// How far a constraint reaches: the deviation of the Gaussian by which constraints are blended.
    #[param(default = 0.2, range = 0.001..=100.0, unit = "model diameters", effect = "larger: smoother blends, single constraints show less")]
    pub reach: f64,
}

impl Evaluate for DirectionFieldNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let field = if self.constraints.is_empty() && self.points.is_empty() {
            DirectionField::toward(&self.mesh, DVec3::from(self.toward))?
        } else {
            let vectors: Vec<Constraint> =
                self.constraints.iter().map(|c| Constraint { at: DVec3::from(c.at), along: DVec3::from(c.along) }).collect();
            let points: Vec<PointConstraint> = self.points.iter().map(DirectionPoint::constraint).collect();
            DirectionField::from_constraints(&self.mesh, &vectors, &points, self.reach)?
        };
        Ok(field.into())
    }
}

impl DirectionPoint {
    fn constraint(&self) -> PointConstraint {
        let flow = match self.flow {
            PointFlow::Turned { turn } => Flow::Turned(turn.to_radians()),
            PointFlow::Saddle { along } => Flow::Saddle(DVec3::from(along)),
        };
        PointConstraint { at: DVec3::from(self.at), flow }
    }
}

/// A number that grows from one end of the model to the other.
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(values: ScalarField, "A number for each vertex.")]
pub struct ScalarRamp {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// From which end to which.
    #[param(default = [0.0, 1.0, 0.0], unit = "direction")]
    pub along: [f64; 3],
    /// The value at the near end.
    #[param(default = 0.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur at the near end")]
    pub from: f64,
    /// The value at the far end.
    #[param(default = 1.0, range = -1000.0..=1000.0, unit = "value", effect = "as a length factor: shorter or longer fur at the far end")]
    pub to: f64,
}

impl Evaluate for ScalarRamp {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(ScalarField::ramp(&self.mesh, DVec3::from(self.along), self.from as f32, self.to as f32)?.into())
    }
}

/// A colour that changes from one end of the model to the other (L18).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "A colour for each vertex.")]
pub struct ColourRamp {
    /// The surface.
    #[input]
    pub mesh: Arc<Mesh>,
    /// From which end to which.
    #[param(default = [0.0, 1.0, 0.0], unit = "direction")]
    pub along: [f64; 3],
    /// The colour at the near end.
    #[param(default = Colour([0.4, 0.4, 0.4]))]
    pub from: Colour,
    /// The colour at the far end.
    #[param(default = Colour([1.0, 1.0, 1.0]))]
    pub to: Colour,
}

impl Evaluate for ColourRamp {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(ColourField::ramp(&self.mesh, DVec3::from(self.along), linear(self.from), linear(self.to))?.into())
    }
}

/// An image laid on the surface through the model's own texture coordinates: colour (L18), and length in its alpha (N5).
#[derive(Node)]
#[node(category = "Fields", version = 1)]
#[output(colours: ColourField, "The image's colour at each vertex.")]
#[output(lengths: ScalarField, "The image's alpha at each vertex: 1 is full length, 0 is bare.")]
pub struct ImageField {
    /// The surface; it must have texture coordinates.
    #[input]
    pub mesh: Arc<Mesh>,
    /// A PNG or JPEG file.
    #[param]
    pub path: FilePath,
}

impl Evaluate for ImageField {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let path = self.path.as_path();
        let image = image::open(path).map_err(|error| format!("{}: {error}", path.display()))?.into_rgba8();
        let (colours, lengths) = ColourField::from_image(&self.mesh, image.as_raw(), image.width(), image.height())?;
        Ok(ImageFieldOutputs { colours: Some(Arc::new(colours)), lengths: Some(Arc::new(lengths)) })
    }
}
