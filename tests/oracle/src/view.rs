//! World to eye space to pixels, and back along rays.
//!
//! ```text
//!   eye space: x right, y up, z forward          pixels: x right, y down
//!   xs = xe cot(fov/2) / aspect / ze             x = (xs + 1) W / 2
//!   ys = ye cot(fov/2) / ze                      y = (1 - ys) H / 2
//! ```

use crate::scene::{Camera, Scene};
use crate::vec3::{Vec3, cross, dot, normalize, sub};

/// The camera of a scene, ready for use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Screen units per tangent, on x and on y.
    scale: [f64; 2],
    /// The size of the picture in pixels.
    size: [f64; 2],
    pub(crate) near: f64,
    pub(crate) far: f64,
}

impl View {
    pub(crate) fn new(scene: &Scene<'_>) -> Self {
        Self::from_camera(&scene.camera, scene.width, scene.height)
    }

    fn from_camera(camera: &Camera, width: u32, height: u32) -> Self {
        let forward = normalize(sub(camera.target, camera.eye));
        let right = normalize(cross(forward, camera.up));
        let cot = 1.0 / (camera.fov.to_radians() / 2.0).tan();
        let size = [f64::from(width), f64::from(height)];
        Self {
            eye: camera.eye,
            right,
            up: cross(right, forward),
            forward,
            scale: [cot * size[1] / size[0], cot],
            size,
            near: camera.near,
            far: camera.far,
        }
    }

    /// The point in eye space of a point in the world.
    pub(crate) fn to_eye(self, world: Vec3) -> Vec3 {
        let p = sub(world, self.eye);
        [dot(p, self.right), dot(p, self.up), dot(p, self.forward)]
    }

    /// The pixel position of a point in eye space with positive z.
    pub(crate) fn project(&self, [x, y, z]: Vec3) -> [f64; 2] {
        [
            (x * self.scale[0] / z + 1.0) * self.size[0] / 2.0,
            (1.0 - y * self.scale[1] / z) * self.size[1] / 2.0,
        ]
    }

    /// Linear forms of a point in eye space whose signs say on which side of a screen position it projects:
    /// `z (px - x)` and `z (py - y)`.
    pub(crate) fn offset_from(&self, [px, py]: [f64; 2], [x, y, z]: Vec3) -> [f64; 2] {
        let [w, h] = self.size;
        [(x * self.scale[0] + z) * w / 2.0 - px * z, (z - y * self.scale[1]) * h / 2.0 - py * z]
    }

    /// The direction with z = 1 that projects to a screen position.
    pub(crate) fn ray(&self, [x, y]: [f64; 2]) -> Vec3 {
        [(2.0 * x / self.size[0] - 1.0) / self.scale[0], (1.0 - 2.0 * y / self.size[1]) / self.scale[1], 1.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov: 90.0,
            near: 1.0,
            far: 10.0,
        }
    }

    fn close<const N: usize>(a: [f64; N], b: [f64; N]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    #[test]
    fn looking_down_minus_z_keeps_right_right_and_up_up() {
        let view = View::from_camera(&camera(), 200, 100);
        assert!(close(view.to_eye([1.0, 2.0, 0.0]), [1.0, 2.0, 5.0]));
        // At 90 degrees the top of the picture is at ye = ze, and the right border at xe = 2 ze.
        assert!(close(view.project([0.0, 5.0, 5.0]), [100.0, 0.0]));
        assert!(close(view.project([10.0, -5.0, 5.0]), [200.0, 100.0]));
    }

    #[test]
    fn rays_and_offsets_agree_with_projection() {
        let mut camera = camera();
        camera.eye = [3.0, -2.0, 1.0];
        camera.fov = 37.0;
        let view = View::from_camera(&camera, 320, 180);
        let point = [0.7, -0.3, 2.5];
        let pixel = view.project(point);
        assert!(close(view.ray(pixel).map(|c| c * 2.5), point));
        assert!(close(view.offset_from(pixel, point), [0.0, 0.0]));
        let [dx, dy] = view.offset_from([pixel[0] - 3.0, pixel[1] + 2.0], point);
        assert!(close([dx, dy], [7.5, -5.0]));
    }
}
