//! From where, and before what.

use glam::{Mat4, Vec3};

/// A perspective camera, in coat coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: Vec3,
    /// What it looks at; not the eye itself.
    pub target: Vec3,
    /// Which way is up; not along the view.
    pub up: Vec3,
    /// The vertical angle of view, in radians, above 0 and under π.
    pub field_of_view: f32,
    /// Nothing nearer to the eye than this is seen; positive, in diameters.
    pub near: f32,
}

impl Camera {
    /// A camera that sees the whole of a ball around `centre` with `radius`, from the direction of azimuth and elevation, in radians.
    ///
    /// Azimuth 0 looks along −z, and grows anticlockwise seen from above; elevation is above the horizon. `margin` 1 lets the ball touch the
    /// picture's shorter side; `aspect` is width over height.
    pub fn framing(centre: Vec3, radius: f32, azimuth: f32, elevation: f32, field_of_view: f32, aspect: f32, margin: f32) -> Self {
        let half_angle = if aspect < 1.0 { ((0.5 * field_of_view).tan() * aspect).atan() } else { 0.5 * field_of_view };
        let distance = margin * radius / half_angle.sin();
        let away = Vec3::new(elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos());
        // Straight up and down, "up" is where the picture's top would go a moment before.
        let up = if elevation.cos().abs() < 1e-4 { -elevation.signum() * Vec3::new(azimuth.sin(), 0.0, azimuth.cos()) } else { Vec3::Y };
        Self { eye: centre + distance * away, target: centre, up, field_of_view, near: (0.01 * distance).max(1e-6) }
    }

    /// The unit direction from the target to the eye; what the paper's viewer at infinity looks along. Zero if they coincide.
    pub fn toward_eye(&self) -> Vec3 {
        (self.eye - self.target).normalize_or_zero()
    }

    /// From coat coordinates to clip space, wgpu's depth range reversed: 1 at the near plane, 0 at infinity, which spreads `f32`'s steps evenly.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        let view = glam::camera::rh::view::look_at_mat4(self.eye, self.target, self.up);
        let focal = 1.0 / (0.5 * self.field_of_view).tan();
        let projection = Mat4::from_cols_array(&[
            focal / aspect,
            0.0,
            0.0,
            0.0, //
            0.0,
            focal,
            0.0,
            0.0, //
            0.0,
            0.0,
            0.0,
            -1.0, //
            0.0,
            0.0,
            self.near,
            0.0,
        ]);
        projection * view
    }
}

/// What is behind the model: a vertical ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background {
    /// At the top of the picture.
    pub top: Vec3,
    /// At the bottom.
    pub bottom: Vec3,
}
