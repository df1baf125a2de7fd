//! The whole pipeline by a [`Pass`], against the same in `f64`: where on the screen a triangle appears.
//!
//! Each vertex carries its own place on the screen, found in `f64`, and as a `Linear` component. So a pixel in which
//! all is right shows the pixel's centre, and the difference from it is by how much the picture is moved there.

use crate::EPS;
use crate::axis::Note;
use crate::measured::Sample;
use alberti::glam::{DVec2, DVec3, Mat3, Vec2, Vec3};
use alberti::lanes::One;
use alberti::{
    Camera, Cull, F32, Frame, Linear, Mesh, Pass, Perspective, Point3, Rgba8888, Target, View, Viewport,
};
use alberti_oracle::rng::Rng;
use std::cell::Cell;

/// Columns and rows of the picture.
const SIDE: u32 = 1024;
const HALF: f64 = SIDE as f64 / 2.0;

/// A way to place a mesh in front of a camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene {
    /// The full vertical angle, in degrees.
    pub(crate) degrees: f64,
    /// The distance of the mesh from the eye.
    pub(crate) distance: f64,
    /// The distance of the mesh from the world's origin.
    pub(crate) offset: f64,
    /// The unit of object coordinates, if the mesh has a frame of its own.
    pub(crate) unit: Option<f64>,
}

/// A camera in `f64`, of the numbers that the library gets.
struct Exact64 {
    eye: DVec3,
    /// Right, up, forward.
    axes: [DVec3; 3],
    /// The sine of the angle between `up` and the view.
    sine: f64,
    cotangent: f64,
}

impl Exact64 {
    fn new([eye, target, up]: [Vec3; 3], fov: f32) -> Self {
        let [eye, target, up] = [eye, target, up].map(Vec3::as_dvec3);
        let forward = (target - eye).normalize();
        let across = forward.cross(up.normalize());
        let right = across.normalize();
        let axes = [right, right.cross(forward), forward];
        Self { eye, axes, sine: across.length(), cotangent: 1.0 / (f64::from(fov) / 2.0).tan() }
    }

    fn to_eye(&self, world: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(world - self.eye)))
    }

    /// From the middle of the picture, in pixels, y downwards.
    fn to_screen(&self, eye: DVec3) -> DVec2 {
        DVec2::new(eye.x, -eye.y) * (self.cotangent * HALF / eye.z)
    }

    fn at_screen(&self, screen: DVec2, z: f64) -> DVec3 {
        let [x, y] = (screen * z / (self.cotangent * HALF)).to_array();
        self.eye + self.axes[0] * x - self.axes[1] * y + self.axes[2] * z
    }

    /// The sums of the magnitudes of the terms of a product with the axes.
    fn terms(&self, v: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.abs().dot(v.abs())))
    }
}

/// A triangle of the scene, as the library gets it.
#[derive(Debug)]
struct Given {
    camera: [Vec3; 3],
    fov: f32,
    planes: [f32; 2],
    /// The origin of the mesh's frame and its unit, if it has one.
    frame: Option<(Vec3, f32)>,
    vertices: [Vec3; 3],
    /// The vertices before they were rounded to `f32`.
    wanted: [DVec3; 3],
    /// The weights of the place that is looked at.
    shares: [f64; 3],
}

impl Given {
    fn any(scene: &Scene, rng: &mut Rng) -> Self {
        let mut direction = || {
            let [x, y, z] = [(); 3].map(|()| rng.uniform(-1.0, 1.0));
            DVec3::new(x, y, z).try_normalize().unwrap_or(DVec3::X)
        };
        let (center, view, up) = (direction() * scene.offset, direction(), direction());
        let up = if view.cross(up).length() < 0.5 { view.any_orthonormal_vector() } else { up };
        let camera = [center - view * scene.distance, center, up].map(DVec3::as_vec3);
        let fov = (scene.degrees as f32).to_radians();
        let exact = Exact64::new(camera, fov);
        let place = |angle: f64, rng: &mut Rng| {
            let (sine, cosine) = (angle + rng.uniform(-0.3, 0.3)).sin_cos();
            let screen = DVec2::new(cosine, sine) * rng.uniform(200.0, 500.0);
            exact.at_screen(screen, scene.distance * rng.uniform(0.7, 1.4))
        };
        let wanted = [0.0, 2.1, 4.2].map(|angle| place(angle, rng));
        let frame = scene.unit.map(|unit| (center.as_vec3(), (1.0 / unit) as f32));
        let vertices = wanted.map(|world| match frame {
            Some((origin, size)) => ((world - origin.as_dvec3()) / f64::from(size)).as_vec3(),
            None => world.as_vec3(),
        });
        let shares = [(); 3].map(|()| rng.uniform(0.1, 1.0));
        let sum: f64 = shares.iter().sum();
        let planes = [scene.distance / 100.0, scene.distance * 100.0].map(|z| z as f32);
        Self { camera, fov, planes, frame, vertices, wanted, shares: shares.map(|share| share / sum) }
    }

    fn view(&self) -> Option<View> {
        let [eye, target, up] = self.camera;
        Camera::look_at(eye, target, up).ok()?.perspective(self.fov, self.planes[0]..self.planes[1]).ok()
    }

    /// Whether its numbers are beyond those of which a triangle is drawn.
    fn is_dropped(&self) -> bool {
        let most = f32::MAX / 16.0;
        let size = self.frame.map_or(1.0, |(_, size)| size);
        !size.is_finite() || self.vertices.iter().any(|v| v.abs().max_element() > most)
    }

    /// The vertices in the world, exactly.
    fn world(&self) -> [DVec3; 3] {
        self.vertices.map(|v| match self.frame {
            Some((origin, size)) => origin.as_dvec3() + v.as_dvec3() * f64::from(size),
            None => v.as_dvec3(),
        })
    }

    /// The greatest distance on the screen, on an axis, that the documented bounds allow a vertex.
    fn bound(&self, exact: &Exact64, vertex: usize) -> f64 {
        let world = self.world()[vertex];
        let place = exact.to_eye(world);
        // The axes of `look_at`, and the origin of `inverse_orthonormal`.
        let relative = world - exact.eye;
        let axes = 4.0 / exact.sine * (relative.x.abs() + relative.y.abs() + relative.z.abs());
        let origin = DVec3::from_array(exact.axes.map(|axis| axis.dot(exact.eye).abs()));
        let mut eps = DVec3::splat(axes) + 3.0 * exact.terms(exact.eye);
        match self.frame {
            // `to_parent`, once.
            None => eps += 4.0 * (exact.terms(world) + origin),
            // The product of two frames, and then `to_parent`.
            Some((center, size)) => {
                let object = self.vertices[vertex].as_dvec3() * f64::from(size);
                let middle = exact.to_eye(center.as_dvec3()).abs();
                eps += 3.0 * exact.terms(object) + 4.0 * (exact.terms(center.as_dvec3()) + origin);
                eps += 4.0 * (exact.terms(object) + middle);
            }
        }
        // A second-order term for all of these together.
        let moved = eps * EPS * (1.0 + 64.0 * EPS);
        let room = place.z - moved.z;
        if room <= 0.0 {
            return f64::INFINITY;
        }
        let screen = exact.to_screen(place);
        let axis = |moved_by: f64, at: f64| {
            let slope = at.abs() / (exact.cotangent * HALF);
            // `Perspective::scale` and `project`, `Viewport::to_screen`, and 256ths of a subpixel.
            let away = exact.cotangent * HALF * (moved_by + slope * moved.z) / room;
            away + 4.01 * EPS * (at.abs() + away) + 2f64.powi(-16)
        };
        f64::max(axis(moved.x, screen.x), axis(moved.y, screen.y))
    }
}

/// The distance on the screen, in pixels, by which a triangle is beside its place.
pub(crate) fn displaced(scene: &Scene, rng: &mut Rng, note: &mut Note) -> Sample {
    let given = Given::any(scene, rng);
    note.take(|| format!("{given:?}"));
    let Some(view) = given.view() else { return Sample::REFUSED };
    let exact = Exact64::new(given.camera, given.fov);
    let screen = given.world().map(|world| exact.to_screen(exact.to_eye(world)));
    // Interpolation adds to what the vertices are off by, and so does the rounding of what they carry.
    let rounded = (13.0 + 1.0) * EPS * screen.iter().fold(0.0, |most, p| p.abs().max_element().max(most));
    let bound = [0, 1, 2].into_iter().fold(0.0, |most, i| given.bound(&exact, i).max(most)) + rounded;
    let middle: DVec2 = (0..3).map(|i| screen[i] * given.shares[i]).sum();
    let pixel = (middle + HALF).floor().clamp(DVec2::ZERO, DVec2::splat(2.0 * HALF - 1.0));
    match drawn(&given, &view, screen, pixel) {
        Some(found) => Sample::new((found - (pixel + 0.5 - HALF)).abs().max_element(), bound),
        None if given.is_dropped() => Sample::REFUSED,
        // Beside its place by more than what was left to the nearest edge.
        None => Sample::new(to_edges(screen, pixel + 0.5 - HALF), bound),
    }
}

/// The place that a pixel shows, of vertices that carry theirs.
fn drawn(given: &Given, view: &View, screen: [DVec2; 3], pixel: DVec2) -> Option<DVec2> {
    let vertices: [(Vec3, Vec2); 3] = [0, 1, 2].map(|i| (given.vertices[i], screen[i].as_vec2()));
    let mesh = Mesh::new(&vertices, &[[0u16, 1, 2]], |&(place, carried)| (place, Linear(carried)));
    let found = Cell::new(None);
    let stage = |Linear(place): Linear<Vec2>| {
        found.set(Some(place));
        Some(u32::MAX)
    };
    let mut pass = Pass::new(view, &mesh, stage).cull(Cull::None);
    if let Some((origin, size)) = given.frame {
        pass = pass.at(Frame::from_mat3(Mat3::from_diagonal(Vec3::splat(size)), Point3::new(origin)));
    }
    let (mut color, mut depth) = ([0; SIDE as usize], [1.0; SIDE as usize]);
    let [column, row] = [pixel.x, pixel.y].map(|c| c as i32);
    let mut band = Target::band(Rgba8888, F32, [SIDE; 2], row.unsigned_abs(), &mut color, &mut depth).ok()?;
    pass.draw_by(One, &mut band.scissor(column..column + 1, row..row + 1));
    found.get().map(Vec2::as_dvec2)
}

/// The distance of a point inside a triangle to its nearest edge.
fn to_edges(screen: [DVec2; 3], point: DVec2) -> f64 {
    let edge = |i: usize| {
        let (a, b) = (screen[i], screen[(i + 1) % 3]);
        // Of a triangle without area, that nothing covers, it is 0.
        ((b - a).perp_dot(point - a) / (b - a).length().max(f64::MIN_POSITIVE)).abs()
    };
    edge(0).min(edge(1)).min(edge(2))
}

/// The distance on the screen by which the rounding of coordinates to `f32` moves them, all else being exact.
pub(crate) fn rounded(scene: &Scene, rng: &mut Rng, note: &mut Note) -> Sample {
    let given = Given::any(scene, rng);
    note.take(|| format!("{given:?}"));
    let exact = Exact64::new(given.camera, given.fov);
    let vertex = rng.index(3);
    let (wanted, world) = (given.wanted[vertex], given.world()[vertex]);
    let [at, found] = [wanted, world].map(|world| exact.to_screen(exact.to_eye(world)));
    let moved = EPS * (1.0 + EPS) * exact.terms(wanted);
    let place = exact.to_eye(wanted);
    let room = place.z - moved.z;
    let axis =
        |moved_by: f64, at: f64| (exact.cotangent * HALF * moved_by + at.abs() * moved.z) / room + 1e-9;
    let bound = f64::max(axis(moved.x, at.x), axis(moved.y, at.y));
    Sample::new((found - at).abs().max_element(), if room > 0.0 { bound } else { f64::INFINITY })
}

/// The distance, in pixels of a picture of 16384, of a point between the sides of a pyramid from its place; on the
/// subpixel to which it is snapped, or as the rasterizer keeps it.
pub(crate) fn projected(degrees: f64, snapped: bool, rng: &mut Rng, note: &mut Note) -> Sample {
    use alberti::projection::EyeVertex;
    const SIZE: u32 = 16_384;
    let fov = (degrees as f32).to_radians();
    let (Ok(lens), Ok(window)) = (Perspective::new(fov, 1.0, 1e-3, 1e3), Viewport::new(0, 0, SIZE, SIZE))
    else {
        return Sample::REFUSED;
    };
    let z = rng.log_uniform(1e-3, 1e3);
    let tangent = (f64::from(fov) / 2.0).tan();
    let [x, y] = [(); 2].map(|()| (rng.uniform(-1.0, 1.0) * tangent * f64::from(z)) as f32);
    note.take(|| format!("{x:e}, {y:e}, {z:e} at {fov:e}"));
    let place = lens.scale(Point3::new(Vec3::new(x, y, z)));
    let found = lens.project(&lens.depth_map(false), &EyeVertex { position: place, varying: () });
    let Some(screen) = window.to_screen(alberti::Sub8, found.x, found.y) else {
        return Sample::new(f64::INFINITY, 0.0);
    };
    let half = f64::from(SIZE) / 2.0;
    let exact = [x, -y].map(|c| f64::from(c) / tangent / f64::from(z) * half);
    let axis = |k: usize| {
        let moved = if snapped { 0.0 } else { f64::from(screen[k].moved()) / 256.0 };
        let found = (f64::from(screen[k].subpixels()) + moved) / 256.0 - half;
        let left = if snapped { 1.0 / 512.0 } else { 2f64.powi(-16) };
        Sample::new(found - exact[k], 4.002 * EPS * exact[k].abs() + left)
    };
    let [x, y] = [axis(0), axis(1)];
    if x.share() > y.share() { x } else { y }
}
