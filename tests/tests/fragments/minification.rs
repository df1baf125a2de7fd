//! Trilinear pictures as they are drawn, against `f64`, which finds coordinates, level of detail and colour by itself.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "small"
)]

use alberti::lanes::{Floating, Machine, One};
use alberti::raster::{Cull, Exact, NoDepth, Paint, Rgba8888, Target, Vertex};
use alberti::shaders::Unlit;
use alberti::texture::format::Scalars;
use alberti::texture::mipmap::{build, texel_count};
use alberti::texture::{Mipmap, Repeat, Trilinear};
use alberti::{Rgba8, Sub8, for_lanes, glam::Vec2};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::narrow::Narrow;
use alberti_tests::probe::vertex;

const FRAME: usize = 96;
/// The texture's side, and the greatest coordinate of a vertex.
const SIDE: u32 = 64;
const GREATEST: f64 = 4.0;

/// A triangle on the screen, in subpixels, with 1/z and texture coordinates at its corners.
struct Seen {
    corners: [[i64; 2]; 3],
    q: [f32; 3],
    uv: [Vec2; 3],
}

impl Seen {
    /// The triangle over half of the frame or more, up to 20 times as far at one corner as at another.
    fn any(rng: &mut Rng) -> Self {
        loop {
            let corners = [(); 3].map(|()| [(); 2].map(|()| rng.range(-24 * 256, 120 * 256)));
            let [a, b, c] = corners;
            if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() < 9000 << 16 {
                continue;
            }
            let mut uv = || rng.uniform(-GREATEST, GREATEST) as f32;
            let uv = [(); 3].map(|()| Vec2::new(uv(), uv()));
            return Self { corners, q: [(); 3].map(|()| rng.log_uniform(0.05, 1.0)), uv };
        }
    }

    /// The pixels.
    fn drawn(&self, lanes: impl Floating, mipmap: Mipmap<'_, Rgba8888>) -> Vec<u32> {
        let vertices: [Vertex<Vec2>; 3] =
            std::array::from_fn(|i| vertex(self.corners[i], 0.5, self.q[i], self.uv[i]));
        let [a, b, c] = &vertices;
        let (mut color, mut depth) = (vec![0; FRAME * FRAME], vec![(); FRAME * FRAME]);
        let size = FRAME as u32;
        let mut target = Target::new(Rgba8888, NoDepth, size, size, &mut color, &mut depth).expect("a frame");
        let stage = Narrow(Unlit(mipmap.sampler(Trilinear, Repeat)));
        let paint = Paint { stage, interpolation: Exact, subpixel: Sub8, cull: Cull::None };
        paint.triangle(lanes, &mut target, [a, b, c], &mut ());
        color
    }

    /// Texture coordinates, in texels, and λ at a place of the screen, in pixels: U/Q and V/Q, and their derivatives by
    /// the quotient rule.
    fn at(&self, [x, y]: [f64; 2]) -> ([f64; 2], f64) {
        let [a, b, c] = self.corners.map(|corner| corner.map(|n| n as f64 / 256.0));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        // Weight of a corner opposite to the edge from p to r, and its derivatives.
        let weight = |p: [f64; 2], r: [f64; 2]| {
            let [dx, dy] = [(p[1] - r[1]) / area, (r[0] - p[0]) / area];
            [dx * (x - p[0]) + dy * (y - p[1]), dx, dy]
        };
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        // Value and derivatives of a number that is linear on the screen.
        let linear = |of: &dyn Fn(usize) -> f64| {
            [0, 1, 2].map(|k| (0..3).map(|i| weights[i][k] * f64::from(self.q[i]) * of(i)).sum::<f64>())
        };
        let [q, qx, qy] = linear(&|_| 1.0);
        let quotient = |[n, nx, ny]: [f64; 3]| [n / q, (nx - n / q * qx) / q, (ny - n / q * qy) / q];
        let side = f64::from(SIDE);
        let [u, ux, uy] = quotient(linear(&|i| f64::from(self.uv[i].x) * side));
        let [v, vx, vy] = quotient(linear(&|i| f64::from(self.uv[i].y) * side));
        ([u, v], ux.hypot(vx).max(uy.hypot(vy)).log2())
    }
}

/// The trilinear mean in `f64`, with weights of `f64`.
fn mean(mipmap: Mipmap<'_, Rgba8888>, [u, v]: [f64; 2], lambda: f64) -> [f64; 3] {
    let level = |level: usize| {
        let texture = mipmap.level(level);
        let side = texture.width();
        let [x, y] = [u, v].map(|t| t / f64::from(1u32 << level) - 0.5);
        let at = |dx: f64, dy: f64| {
            let [column, row] =
                [x.floor() + dx, y.floor() + dy].map(|i| i.rem_euclid(f64::from(side)) as u32);
            texture.texel(column, side - 1 - row).to_bytes().map(f64::from)
        };
        let (s, t) = (x - x.floor(), y - y.floor());
        let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
        [0, 1, 2].map(|k| (a[k] * (1.0 - s) + b[k] * s) * (1.0 - t) + (c[k] * (1.0 - s) + d[k] * s) * t)
    };
    let last = mipmap.levels() - 1;
    let lambda = lambda.clamp(0.0, last as f64);
    let near = lambda.floor() as usize;
    let part = lambda - near as f64;
    let (near, far) = (level(near), level(last.min(near + 1)));
    [0, 1, 2].map(|k| near[k] * (1.0 - part) + far[k] * part)
}

/// Noise of 0 and 255, waves and a board.
fn images(rng: &mut Rng) -> [Vec<[u8; 4]>; 3] {
    let wave = |x: f64| (127.5 + 127.5 * x) as u8;
    let place = |i: usize| [i % SIDE as usize, i / SIDE as usize];
    let turn = |i: usize| place(i).map(|c| c as f64 * std::f64::consts::TAU / f64::from(SIDE));
    let mut noise = |_: usize| [(); 3].map(|()| 255 * u8::from(rng.one_in(2)));
    let waves = |i: usize| turn(i).map(|t| [t.sin(), (3.0 * t).cos()]);
    let waves =
        |i: usize| [wave(waves(i)[0][0]), wave(waves(i)[1][1]), wave(waves(i)[0][1] * waves(i)[1][0])];
    let board = |i: usize| [255 * u8::from(place(i).iter().map(|c| c / 8).sum::<usize>() % 2 == 1); 3];
    let image = |of: &mut dyn FnMut(usize) -> [u8; 3]| {
        let mut texels = vec![[0, 0, 0, 255]; texel_count(SIDE, SIDE)];
        for (i, texel) in texels.iter_mut().enumerate().take((SIDE * SIDE) as usize) {
            texel[..3].copy_from_slice(&of(i));
        }
        build(Scalars(Rgba8888), &mut texels, SIDE, SIDE).expect("a chain");
        texels
    };
    [image(&mut noise), image(&mut { waves }), image(&mut { board })]
}

/// At most one step and half a step of rounding, beyond what a λ that is off by 2^-9 and coordinates that are off by
/// 9ε of the greatest may change.
#[test]
fn trilinear_pictures_of_planes_in_perspective() {
    let mut rng = Rng::stream(run_seed(), 40);
    let images = images(&mut rng);
    let (mut worst, mut beyond, mut counts) = (0f64, 0f64, [0u32; 2]);
    // Both coordinates, and bytes that change by 255 a texel.
    let places = 2.0 * 9.0 / 2f64.powi(24) * GREATEST * f64::from(SIDE) * 255.0;
    for i in 0..150 {
        let mipmap = Mipmap::new(Rgba8888, &images[i % 3], SIDE, SIDE).expect("a mip map");
        let seen = Seen::any(&mut rng);
        let drawn = seen.drawn(One, mipmap);
        for machine in Machine::all() {
            assert!(for_lanes!(machine, lanes => seen.drawn(lanes, mipmap)) == drawn);
        }
        for (at, pixel) in drawn.into_iter().enumerate() {
            let [r, g, b, a] = Rgba8::from_bits(pixel).to_bytes();
            if a == 0 {
                continue;
            }
            let (uv, lambda) = seen.at([(at % FRAME) as f64 + 0.5, (at / FRAME) as f64 + 0.5]);
            counts[usize::from(lambda > 0.0)] += 1;
            let [exact, less, more] = [0.0, -1.0, 1.0].map(|by| mean(mipmap, uv, lambda + by / 512.0));
            for (k, byte) in [r, g, b].into_iter().enumerate() {
                let error = (f64::from(byte) - exact[k]).abs();
                let allowed = (less[k] - exact[k]).abs().max((more[k] - exact[k]).abs()) + places;
                worst = worst.max(error);
                beyond = beyond.max(error - allowed);
                assert!(error <= 1.5 + allowed, "{byte} for {}, λ = {lambda}", exact[k]);
            }
        }
    }
    println!("{counts:?} pixels magnified and minified: {worst:.3} off, {beyond:.3} beyond λ and places");
    assert!(counts.iter().all(|&count| count > 20_000) && beyond > 0.5);
}
