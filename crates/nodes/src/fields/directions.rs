//! Which way fur lies.

use std::sync::Arc;

use glam::DVec3;
use pelage_field::{Constraint, DirectionField, Flow, PointConstraint};
use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_mesh::Mesh;

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
