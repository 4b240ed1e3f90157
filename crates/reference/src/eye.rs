//! A camera's rays.

use glam::DVec3;
use pelage_coat::Camera;

use crate::ReferenceError;
use crate::ray::Ray;

/// A camera before a picture of a size, in `f64`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Eye {
    origin: DVec3,
    forward: DVec3,
    /// Half of the picture's plane at distance 1.
    right: DVec3,
    up: DVec3,
    near: f64,
    size: [f64; 2],
}

impl Eye {
    pub(crate) fn new(camera: &Camera, size: (u32, u32)) -> Result<Self, ReferenceError> {
        let refused = |what| Err(ReferenceError::Camera { what });
        let field_of_view = f64::from(camera.field_of_view);
        if !(camera.eye.is_finite() && camera.target.is_finite() && camera.up.is_finite()) {
            return refused("eye, target and up must be finite");
        }
        if !(field_of_view > 0.0 && field_of_view < std::f64::consts::PI) {
            return refused("its angle of view must be above 0 and under π");
        }
        if !(camera.near >= 0.0 && camera.near.is_finite()) {
            return refused("its near plane must be finite and not behind it");
        }
        let (origin, up) = (camera.eye.as_dvec3(), camera.up.as_dvec3());
        let Some(forward) = (camera.target.as_dvec3() - origin).try_normalize() else {
            return refused("it must look at something else than itself");
        };
        let Some(right) = forward.cross(up).try_normalize() else { return refused("up must not be along the view") };
        let half = (0.5 * field_of_view).tan();
        let size = [f64::from(size.0), f64::from(size.1)];
        let aspect = if size[1] > 0.0 { size[0] / size[1] } else { 1.0 };
        Ok(Self { origin, forward, right: right * half * aspect, up: right.cross(forward) * half, near: f64::from(camera.near), size })
    }

    /// The ray through a place of the picture, in pixels from the top left.
    pub(crate) fn ray(&self, x: f64, y: f64) -> Ray {
        let way = self.forward + self.right * (2.0 * x / self.size[0] - 1.0) + self.up * (1.0 - 2.0 * y / self.size[1]);
        let length = way.length();
        // The near plane is as far along the view, not along the ray.
        Ray { origin: self.origin, direction: way / length, from: self.near * length, to: f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, Vec4};

    #[test]
    fn rays_go_where_the_renderer_s_matrix_has_them() {
        let camera =
            Camera { eye: Vec3::new(1.0, 2.0, 3.0), target: Vec3::new(0.1, -0.2, 0.3), up: Vec3::Y, field_of_view: 0.7, near: 0.01 };
        let (width, height) = (640, 480);
        let eye = Eye::new(&camera, (width, height)).unwrap();
        let matrix = camera.view_projection(width as f32 / height as f32);
        for (x, y) in [(0.0, 0.0), (320.0, 240.0), (639.5, 0.5), (100.25, 470.75)] {
            let ray = eye.ray(x, y);
            let clip = matrix * Vec4::from((ray.at(2.5).as_vec3(), 1.0));
            let pixel = [(0.5 + 0.5 * clip.x / clip.w) * width as f32, (0.5 - 0.5 * clip.y / clip.w) * height as f32];
            assert!((f64::from(pixel[0]) - x).abs() < 1e-2 && (f64::from(pixel[1]) - y).abs() < 1e-2, "{pixel:?} for {x}, {y}");
        }
    }
}
