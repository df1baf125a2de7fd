//! The level of detail of textured planes in perspective, against its closed form.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "pixels within a frame")]

use alberti_math::glam::Vec3;
use alberti_math::{Point3, Sub8};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{EyeVertex, Perspective, Viewport};
use alberti_raster::{Exact, PerPixel, Vertex};
use alberti_tests::derivatives::{SIZE, carried, told};
use alberti_tests::probe::unsnapped;

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

/// The level of detail within 2^-9 of that of the plane, turned about the eye and in itself, with pixels up to 1000
/// times as long as they are wide, and q up to 100 times as great at one end of a triangle as at the other.
#[test]
fn levels_of_detail_of_turned_planes() {
    turned_planes(30, 0, 1.0 / 512.0);
}

/// The same of vertices anywhere, which are snapped.
#[test]
fn levels_of_detail_of_snapped_planes() {
    turned_planes(31, 128, 1.0 / 512.0);
}

/// Planes whose vertices are up to so many 256ths of subpixels beside where they are drawn, on each axis.
fn turned_planes(stream: u64, beside: i64, bound: f64) {
    const PLANES: u32 = 100_000;
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut worst, mut count, mut steep) = (0f64, 0, 0);
    for plane in 0..PLANES {
        let corner = [rng.range(0, 8000), rng.range(0, 8000)];
        let side = rng.range(65, 2000);
        let at = |x: i64, y: i64| [(corner[0] + x * side) * 256, (corner[1] + y * side) * 256];
        let tri = [at(0, 0), at(1, 0), at(0, 1)];
        let mut inside = || [0, 1].map(|k| (corner[k] + rng.range(1, side / 2 - 1)) as i32);
        let [pixel, base] = [inside(), inside()];
        let parts = tri.map(|p| p.map(|c| 256 * c + rng.range(-beside, (beside - 1).max(0))));
        let corners = parts.map(|p| p.map(|c| c as f64 / 65_536.0));
        let direction = turn(rng.uniform(0.0, std::f64::consts::TAU))[0];
        let along = |p: [f64; 2]| p[0] * direction[0] + p[1] * direction[1];
        let [low, high] = [f64::min, f64::max].map(|f| corners.map(along).into_iter().reduce(f).unwrap());
        let least = f64::from(rng.log_uniform(0.01, 1.0));
        let rise = (1.0 - least) / (high - low);
        let p0 = base.map(|c| f64::from(c) + 0.5);
        let texels = f64::from(rng.log_uniform(1e-3, 1e3));
        let anisotropy = f64::from(rng.log_uniform(1.0, 1000.0));
        let angle = f64::from(plane) * std::f64::consts::TAU / f64::from(PLANES);
        let axes = [[texels, 0.0], [0.0, texels / anisotropy]];
        let g = times(turn(rng.uniform(0.0, std::f64::consts::TAU)), times(axes, turn(angle)));
        let textured =
            Textured { g, p0, q0: least + (along(p0) - low) * rise, slope: direction.map(|c| c * rise) };
        let values = corners.map(|p| {
            let [u, v] = textured.value(p);
            [(u / f64::from(SIZE[0])) as f32, (v / f64::from(SIZE[1])) as f32, 0.0, 0.0]
        });
        let vertices = std::array::from_fn(|i| {
            unsnapped(parts[i], 0.5, textured.q(corners[i]) as f32, carried(values[i]))
        });
        for (column, told) in told(PerPixel, Exact, &vertices, pixel[1], pixel[0]..pixel[0] + 1) {
            let [du, dv] = textured.derivative([f64::from(column) + 0.5, f64::from(pixel[1]) + 0.5]);
            let square = (du[0] * du[0] + dv[0] * dv[0]).max(du[1] * du[1] + dv[1] * dv[1]);
            let exact = 0.5 * square.log2();
            worst = worst.max((f64::from(told.lambda) - exact).abs());
            assert!(worst <= bound, "{} for {exact}: {vertices:?}", told.lambda);
            count += 1;
            steep += u32::from(anisotropy > 100.0 && least < 0.1);
        }
    }
    println!("level of detail, {beside} beside: {worst:.6} at most (2^{:.2}) of {count}", worst.log2());
    assert!(count == PLANES && steep > 10_000, "{steep} steep of {count}");
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

/// The same planes, projected and put into a viewport as `draw` does, in `f32`: against the plane through the vertices
/// in space.
#[test]
fn levels_of_detail_of_drawn_planes() {
    drawn_planes(32, [65, 1000], 1.0 / 512.0);
}

/// Small triangles keep what their vertices have, so that textures move by half a subpixel.
#[test]
fn levels_of_detail_of_small_drawn_planes() {
    drawn_planes(33, [16, 64], 1.0 / 128.0);
}

/// Planes with sides of so many pixels.
fn drawn_planes(stream: u64, [short, long]: [i64; 2], bound: f64) {
    const PLANES: u32 = 100_000;
    const SIDE: u32 = 2048;
    let half = f64::from(SIDE) / 2.0;
    let projection = Perspective::new(1.0, 1.0, 0.5, 200.0).expect("a pyramid");
    let (depth, viewport) =
        (projection.depth_map(false), Viewport::new(0, 0, SIDE, SIDE).expect("a viewport"));
    let mut rng = Rng::stream(run_seed(), stream);
    let (mut worst, mut count, mut steep) = (0f64, 0, 0);
    while count < PLANES {
        let side = rng.range(short, long) as f64;
        let corner = [(); 2].map(|()| rng.uniform(0.0, f64::from(SIDE) - side - 1.0));
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|d| [0, 1].map(|k| corner[k] + side * d[k]));
        let direction = turn(rng.uniform(0.0, std::f64::consts::TAU))[0];
        let along = |p: [f64; 2]| p[0] * direction[0] + p[1] * direction[1];
        let [low, high] = [f64::min, f64::max].map(|f| places.map(along).into_iter().reduce(f).unwrap());
        let least = f64::from(rng.log_uniform(0.01, 1.0));
        let rise = (1.0 - least) / (high - low);
        let p0 = corner.map(|c| c + rng.uniform(0.0, side / 2.0));
        let anisotropy = f64::from(rng.log_uniform(1.0, 1000.0));
        let texels = f64::from(rng.log_uniform(1e-3, 1e3));
        let axes = [[texels, 0.0], [0.0, texels / anisotropy]];
        let turned = [(); 2].map(|()| turn(rng.uniform(0.0, std::f64::consts::TAU)));
        let textured = Textured {
            g: times(turned[0], times(axes, turned[1])),
            p0,
            q0: least + (along(p0) - low) * rise,
            slope: direction.map(|c| c * rise),
        };
        let vertices = places.map(|p| {
            let z = 1.0 / textured.q(p);
            let [u, v] = textured.value(p);
            let place =
                Vec3::new(((p[0] / half - 1.0) * z) as f32, ((1.0 - p[1] / half) * z) as f32, z as f32);
            (place, [(u / f64::from(SIZE[0])) as f32, (v / f64::from(SIZE[1])) as f32])
        });
        let known = vertices.map(|(p, [u, v])| {
            let q = 1.0 / f64::from(p.z);
            let place = [half + f64::from(p.x) * q * half, half - f64::from(p.y) * q * half];
            Known { place, q, texel: [f64::from(u) * f64::from(SIZE[0]), f64::from(v) * f64::from(SIZE[1])] }
        });
        let on_screen = vertices.map(|(p, [u, v])| {
            let varying = carried([u, v, 0.0, 0.0]);
            let p = projection.project(&depth, &EyeVertex { position: Point3::new(p), varying });
            let [x, y] = viewport.to_screen(Sub8, p.x, p.y).expect("within the guard band");
            Vertex { x, y, zs: p.zs, q: p.q, varying: p.varying }
        });
        let pixel = corner.map(|c| (c + rng.uniform(1.0, side / 2.0 - 1.0)) as i32);
        for (column, told) in told(PerPixel, Exact, &on_screen, pixel[1], pixel[0]..pixel[0] + 1) {
            let exact = exact_level(&known, [f64::from(column) + 0.5, f64::from(pixel[1]) + 0.5]);
            worst = worst.max((f64::from(told.lambda) - exact).abs());
            assert!(worst <= bound, "{} for {exact}: {vertices:?}", told.lambda);
            count += 1;
            steep += u32::from(anisotropy > 100.0 && least < 0.1);
        }
    }
    println!(
        "level of detail as drawn, up to {long} pixels: {worst:.6} at most (2^{:.2}) of {count}",
        worst.log2()
    );
    assert!(steep > 10_000, "{steep} steep of {count}");
}
