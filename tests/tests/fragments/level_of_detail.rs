//! The level of detail of textured planes in perspective, against its closed form, at any pixel of a triangle: of
//! random ones, and climbing from the worst of these.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "pixels within a frame")]

use crate::unsnapped::{Plane, plane};
use alberti_math::glam::Vec3;
use alberti_math::{Fixed, Point3, Sub8, Subpixel};
use alberti_oracle::climb::climb;
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{EyeVertex, Perspective, Viewport};
use alberti_raster::{Exact, PerPixel, Vertex};
use alberti_tests::derivatives::{Carried, SIZE, carried, told};
use alberti_tests::probe::unsnapped;
use alberti_tests::sweep::or_swept;

type Matrix = [[f64; 2]; 2];

fn times(a: Matrix, b: Matrix) -> Matrix {
    a.map(|[x, y]| [x * b[0][0] + y * b[1][0], x * b[0][1] + y * b[1][1]])
}

fn turn(angle: f64) -> Matrix {
    let (sine, cosine) = angle.sin_cos();
    [[cosine, -sine], [sine, cosine]]
}

/// A textured plane in perspective, as the screen sees it: u(p) = G (p - p0) q(p0)/q(p) in texels, q linear in p.
struct Textured {
    g: Matrix,
    p0: [f64; 2],
    q0: f64,
    slope: [f64; 2],
}

impl Textured {
    fn from(&self, p: [f64; 2]) -> [f64; 2] {
        [p[0] - self.p0[0], p[1] - self.p0[1]]
    }

    fn q(&self, p: [f64; 2]) -> f64 {
        let [x, y] = self.from(p);
        self.q0 + self.slope[0] * x + self.slope[1] * y
    }

    fn value(&self, p: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.from(p);
        self.g.map(|row| (row[0] * x + row[1] * y) * self.q0 / self.q(p))
    }

    /// G (1 - (p - p0) (grad q)ᵀ/q(p)) q(p0)/q(p).
    fn derivative(&self, p: [f64; 2]) -> Matrix {
        let ([x, y], [a, b], q) = (self.from(p), self.slope, self.q(p));
        let factor = [[q - x * a, -x * b], [-y * a, q - y * b]];
        times(self.g, factor).map(|row| row.map(|c| c * self.q0 / (q * q)))
    }
}

/// The greatest error that is allowed beyond what snapping does.
const BOUND: f64 = 1.0 / 512.0;

/// A random plane: pixels up to 1000 times as long as they are wide, turned about the eye and in itself, and q from
/// `least` at one end of a triangle to 1 at the other.
struct Random {
    textured: Textured,
    steep: bool,
}

impl Random {
    fn any(rng: &mut Rng, corners: [[f64; 2]; 3], least: f32) -> Self {
        let direction = turn(rng.uniform(0.0, std::f64::consts::TAU))[0];
        let along = |p: [f64; 2]| p[0] * direction[0] + p[1] * direction[1];
        let [low, high] = [f64::min, f64::max].map(|f| corners.map(along).into_iter().reduce(f).unwrap());
        let least = f64::from(rng.log_uniform(least, 1.0));
        let rise = (1.0 - least) / (high - low);
        let p0 = inside(rng, corners);
        let texels = f64::from(rng.log_uniform(1e-3, 1e3));
        let anisotropy = f64::from(rng.log_uniform(1.0, 1000.0));
        let axes = [[texels, 0.0], [0.0, texels / anisotropy]];
        let turned = [(); 2].map(|()| turn(rng.uniform(0.0, std::f64::consts::TAU)));
        let (q0, slope) = (least + (along(p0) - low) * rise, direction.map(|c| c * rise));
        let textured = Textured { g: times(turned[0], times(axes, turned[1])), p0, q0, slope };
        Self { textured, steep: anisotropy > 100.0 && least < 0.1 }
    }

    /// Texture coordinates at a place.
    fn coordinates(&self, place: [f64; 2]) -> [f32; 2] {
        let [u, v] = self.textured.value(place);
        [(u / f64::from(SIZE[0])) as f32, (v / f64::from(SIZE[1])) as f32]
    }
}

/// Any place in a triangle.
fn inside(rng: &mut Rng, [a, b, c]: [[f64; 2]; 3]) -> [f64; 2] {
    let [s, t] = [(); 2].map(|()| rng.unit());
    let [s, t] = if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] };
    [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
}

/// The least height of a triangle.
fn height([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let edge = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
    let ([ux, uy], [vx, vy], [wx, wy]) = (edge(a, b), edge(b, c), edge(c, a));
    (ux * vy - uy * vx).abs() / ux.hypot(uy).max(vx.hypot(vy)).max(wx.hypot(wy))
}

/// λ at a pixel, if the triangle covers it.
fn lambda(vertices: &[Vertex<Carried>; 3], [column, row]: [i32; 2]) -> Option<f64> {
    let told = told(PerPixel, Exact, vertices, row, column..column + 1);
    told.first().map(|(_, told)| f64::from(told.lambda))
}

/// Climbs the error of cases, as a share of what is allowed. None is a case that does not count.
fn climbed(name: &str, stream: u64, mut share: impl FnMut(&mut Rng) -> Option<(f64, bool)>) -> f64 {
    let (samples, steps) = or_swept((100_000, 10_000), (1_000_000, 200_000));
    let (mut count, mut steep) = (0, 0);
    let found = climb(run_seed() ^ stream, samples, steps, |rng| {
        share(rng).map_or(0.0, |(share, is_steep)| {
            count += 1;
            steep += u64::from(is_steep);
            share
        })
    });
    println!("{name}: {:.6} (2^{:.2}), of {count}", found.most, found.most.log2());
    assert!(count > samples / 10 && steep > samples / 50, "{steep} steep of {count}");
    found.most
}

/// Vertices on subpixels.
#[test]
fn levels_of_detail_of_turned_planes() {
    turned_planes(30, 0);
}

/// Large triangles whose vertices are beside them, and moved.
#[test]
fn levels_of_detail_of_snapped_planes() {
    turned_planes(31, 128);
}

/// Planes whose vertices are up to so many 256ths of subpixels beside where they are drawn, on each axis.
fn turned_planes(stream: u64, beside: i64) {
    climbed(&format!("{beside} beside"), stream, |rng| {
        let corner = [rng.range(0, 8000), rng.range(0, 8000)];
        let side = rng.range(65, 2000);
        let at = |x: i64, y: i64| [(corner[0] + x * side) * 256, (corner[1] + y * side) * 256];
        let tri = [at(0, 0), at(1, 0), at(0, 1)];
        let parts = tri.map(|p| p.map(|c| 256 * c + rng.range(-beside, (beside - 1).max(0))));
        let corners = parts.map(|p| p.map(|c| c as f64 / 65_536.0));
        let random = Random::any(rng, corners, 0.01);
        let pixel = inside(rng, corners).map(|c| c as i32);
        let vertices = std::array::from_fn(|i| {
            let ([u, v], q) = (random.coordinates(corners[i]), random.textured.q(corners[i]));
            unsnapped(parts[i], 0.5, q as f32, carried([u, v, 0.0, 0.0]))
        });
        let found = lambda(&vertices, pixel)?;
        let [du, dv] = random.textured.derivative(pixel.map(|c| f64::from(c) + 0.5));
        let square = (du[0] * du[0] + dv[0] * dv[0]).max(du[1] * du[1] + dv[1] * dv[1]);
        let error = (found - 0.5 * square.log2()).abs();
        assert!(error <= BOUND, "{error}: {vertices:?} {pixel:?}");
        Some((error, random.steep))
    });
}

/// A vertex of the texture on a plane: its place in the frame, q, and its texel.
struct Known {
    place: [f64; 2],
    q: f64,
    texel: [f64; 2],
}

/// The gradient of a function that is linear on the screen, and its value at a place.
fn linear(known: &[Known; 3], f: [f64; 3], place: [f64; 2]) -> [f64; 3] {
    let from = |p: [f64; 2]| [p[0] - known[0].place[0], p[1] - known[0].place[1]];
    let ([ax, ay], [bx, by], [x, y]) = (from(known[1].place), from(known[2].place), from(place));
    let (area, a, b) = (ax * by - ay * bx, f[1] - f[0], f[2] - f[0]);
    let [gx, gy] = [(a * by - b * ay) / area, (b * ax - a * bx) / area];
    [gx, gy, f[0] + gx * x + gy * y]
}

/// The level of detail by the quotient rule.
fn exact_level(known: &[Known; 3], place: [f64; 2]) -> f64 {
    let of = |f: &dyn Fn(&Known) -> f64| linear(known, [0, 1, 2].map(|i| f(&known[i])), place);
    let [q_x, q_y, q] = of(&|v| v.q);
    let squares = [0, 1].map(|k| {
        let [n_x, n_y, n] = of(&|v| v.q * v.texel[k]);
        [(n_x * q - n * q_x) / (q * q), (n_y * q - n * q_y) / (q * q)].map(|d| d * d)
    });
    0.5 * (squares[0][0] + squares[1][0]).max(squares[0][1] + squares[1][1]).log2()
}

/// Triangles that are moved are as exact where they are projected and put into a viewport as `draw` does, in `f32`:
/// against the plane through the vertices in space.
#[test]
fn levels_of_detail_of_drawn_planes() {
    drawn_planes(32, [65, 1000], 0.01, Plane::Before);
}

/// Small triangles keep what their vertices have: within the same of what the plane has up to half a subpixel from the
/// sample on each axis.
///
/// The snapped triangle is the other one under the affine map that takes vertex to vertex. A place is moved by at most
/// half a subpixel h on each axis, as a mean of the vertices. Gradients are multiplied by 1 + D. The magnitudes in a
/// column of D sum up to at most 4 h over the least height: from 11 pixels on that changes λ by less than 2^-9.9. The
/// rest is rounding.
#[test]
fn levels_of_detail_of_small_drawn_planes() {
    drawn_planes(33, [16, 64], 0.01, Plane::After);
}

/// The same of large ones that are too steep for the rule.
#[test]
fn levels_of_detail_of_steep_drawn_planes() {
    drawn_planes(34, [65, 300], 1e-5, Plane::After);
}

/// The image's side, and half of it.
const SIDE: u32 = 2048;
const HALF: f64 = SIDE as f64 / 2.0;

/// A triangle in space as it is drawn, and its plane.
struct Drawn {
    vertices: [Vertex<Carried>; 3],
    known: [Known; 3],
    plane: Plane,
}

impl Drawn {
    fn of(random: &Random, places: [[f64; 2]; 3]) -> Self {
        let projection = Perspective::new(1.0, 1.0, 0.5, 1e6).expect("a pyramid");
        let (depth, viewport) =
            (projection.depth_map(false), Viewport::new(0, 0, SIDE, SIDE).expect("a viewport"));
        let vertices = places.map(|p| {
            let z = 1.0 / random.textured.q(p);
            let place =
                Vec3::new(((p[0] / HALF - 1.0) * z) as f32, ((1.0 - p[1] / HALF) * z) as f32, z as f32);
            (place, random.coordinates(p))
        });
        let known = vertices.map(|(p, [u, v])| {
            let q = 1.0 / f64::from(p.z);
            let place = [HALF + f64::from(p.x) * q * HALF, HALF - f64::from(p.y) * q * HALF];
            Known { place, q, texel: [f64::from(u) * f64::from(SIZE[0]), f64::from(v) * f64::from(SIZE[1])] }
        });
        let vertices = vertices.map(|(p, [u, v])| {
            let varying = carried([u, v, 0.0, 0.0]);
            let p = projection.project(&depth, &EyeVertex { position: Point3::new(p), varying });
            let [x, y] = viewport.to_screen(Sub8, p.x, p.y).expect("within the guard band");
            Vertex { x, y, zs: p.zs, q: p.q, varying: p.varying }
        });
        let part = |at: Fixed| i64::from(256 * at.subpixels() + at.moved());
        let parts = [0, 1, 2].map(|i| [vertices[i].x, vertices[i].y].map(part));
        let plane = plane(parts, [0, 1, 2].map(|i| vertices[i].q), Subpixel::Sub8);
        Self { vertices, known, plane }
    }

    /// The least and the greatest level of detail of the plane up to so far from a place on each axis.
    fn levels(&self, [x, y]: [f64; 2], reach: f64) -> [f64; 2] {
        let steps = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|step| step * reach);
        let near = steps.into_iter().flat_map(|dx| steps.map(|dy| [x + dx, y + dy]));
        near.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], place| {
            let level = exact_level(&self.known, place);
            [least.min(level), most.max(level)]
        })
    }
}

/// Planes with sides of so many pixels, and q from `least` on, of triangles that are moved, or that are not.
fn drawn_planes(stream: u64, [short, long]: [i64; 2], least: f32, wanted: Plane) {
    let reach = if wanted == Plane::Before { 0.0 } else { 1.0 / 512.0 };
    let mut whole = 0f64;
    let most = climbed(&format!("up to {long} pixels, {wanted:?}"), stream, |rng| {
        let side = rng.range(short, long) as f64;
        let corner = [(); 2].map(|()| rng.uniform(0.0, f64::from(SIDE) - side - 1.0));
        let shape = if rng.one_in(2) {
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
        } else {
            [(); 3].map(|()| [(); 2].map(|()| rng.unit()))
        };
        let places = shape.map(|d| [0, 1].map(|k| corner[k] + side * d[k]));
        if height(places) < 11.0 {
            return None;
        }
        let random = Random::any(rng, places, least);
        let drawn = Drawn::of(&random, places);
        let pixel = inside(rng, places).map(|c| c as i32);
        let found = lambda(&drawn.vertices, pixel).filter(|_| drawn.plane == wanted)?;
        let centre = pixel.map(|c| f64::from(c) + 0.5);
        let [least, most] = drawn.levels(centre, reach);
        let error = (least - found).max(found - most);
        assert!(error <= BOUND, "{found} for {least} to {most}: {:?} {pixel:?}", drawn.vertices);
        whole = whole.max((found - exact_level(&drawn.known, centre)).abs());
        Some((error.max(0.0), random.steep))
    });
    println!("with what snapping does: {whole:.6} (2^{:.2})", whole.log2());
    // Without it the bound would not hold.
    assert!(most > 0.0 && (reach == 0.0) == (whole <= BOUND), "{most} {whole}");
}
