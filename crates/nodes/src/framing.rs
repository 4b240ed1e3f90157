//! From where to look.

use glam::Vec3;
use pelage_coat::Camera;
use pelage_graph::{Context, Evaluate, Node, NodeError};

/// From which direction to frame a model; the camera follows once the model's bounds and the picture's shape are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Around the vertical axis, anticlockwise seen from above, in radians; 0 looks along −z.
    pub azimuth: f32,
    /// Above the horizon, in radians.
    pub elevation: f32,
    /// The vertical angle of view, in radians.
    pub field_of_view: f32,
    /// 1 lets the ball around the model touch the picture's shorter side; smaller comes closer.
    pub margin: f32,
    /// What is looked at, from the centre, in model diameters.
    pub pan: Vec3,
}

impl Framing {
    /// The camera for a model within `bounds`, on a picture `aspect` times as wide as high.
    pub fn camera(&self, bounds: (Vec3, Vec3), aspect: f32) -> Camera {
        let centre = 0.5 * (bounds.0 + bounds.1) + self.pan;
        let radius = 0.5 * bounds.0.distance(bounds.1);
        Camera::framing(centre, radius, self.azimuth, self.elevation, self.field_of_view, aspect, self.margin)
    }
}

/// From which direction the model is framed.
#[derive(Node)]
#[node(category = "Picture", version = 1, name = "Camera")]
#[output(camera: Framing, "From which direction the model is framed.")]
pub struct CameraNode {
    /// Around the vertical axis, anticlockwise seen from above; 0 looks along −z.
    #[param(default = 0.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
    pub azimuth: f64,
    /// Above the horizon.
    #[param(default = 15.0, range = -90.0..=90.0, unit = "degrees", effect = "none on cost")]
    pub elevation: f64,
    /// The vertical angle of view.
    #[param(default = 30.0, range = 1.0..=150.0, unit = "degrees", effect = "larger: stronger perspective")]
    pub field_of_view: f64,
    /// How far back to stand: at 1 the ball around the model touches the picture's shorter side.
    #[param(default = 0.85, range = 0.01..=1000.0, unit = "ratio", effect = "smaller: closer, so more pixels to fill")]
    pub margin: f64,
    /// What is looked at, from the model's centre.
    #[param(default = [0.0, 0.0, 0.0], unit = "model diameters")]
    pub pan: [f64; 3],
}

impl Evaluate for CameraNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        Ok(Framing {
            azimuth: self.azimuth.to_radians() as f32,
            elevation: self.elevation.to_radians() as f32,
            field_of_view: self.field_of_view.to_radians() as f32,
            margin: self.margin as f32,
            pan: glam::DVec3::from(self.pan).as_vec3(),
        }
        .into())
    }
}
