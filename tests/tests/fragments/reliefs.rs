//! Bump and parallax maps in materials, against closed forms on planes and on a sphere.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "rounded on purpose")]

use alberti::glam::{DVec3, Vec2, Vec3};
use alberti::lanes::{Lanes, One};
use alberti::raster::NoDerivatives;
use alberti::shaders::material::{
    Bump, Color, Directional, Framed, Lambert, Layer, Lighting, Material, NormalMap, OnSurface, Parallax,
    Surface, Viewer,
};
use alberti::texture::surface::{
    CentralDifferences, Grid, LimitedParallax, MeshBuffers, NormalEncoding, OffsetParallax,
    ParallaxOcclusion, Parametric as _, Relief, Sphere, SteepParallax, displaced_mesh,
};
use alberti::texture::{Nearest, Repeat, Texture, format};
use alberti::{Camera, F32, FragmentStage, Mesh, Pass, Point3, Rgba8, Rgba8888, Target, Vector3};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_tests::narrow::Narrow;
use std::cell::Cell;
use std::f64::consts::{PI, TAU};

/// A last layer that keeps what the others made: the normal, and where maps are read.
#[derive(Clone, Copy, Debug)]
struct Keep<'a>(&'a Cell<(Vec3, Vec2)>);

impl<V: OnSurface> Layer<V> for Keep<'_> {
    type Derivatives = NoDerivatives;

    fn apply<L: Lanes>(&self, lanes: L, _: &V::Of<L::Number>, surface: &mut Surface<L>) {
        let first = |x: L::Number| lanes.store(x).as_ref()[0];
        let ([x, y, z], [u, v]) = (surface.normal.map(first), surface.uv.map(first));
        self.0.set((Vec3::new(x, y, z), Vec2::new(u, v)));
    }
}

/// What a layer makes of a surface that is seen from `eye`.
fn seen(layer: impl Layer<Framed>, eye: Vec3, surface: Framed) -> (Vec3, Vec2) {
    let kept = Cell::default();
    let viewer = Viewer::at(Point3::new(eye));
    let lighting = Lighting { viewer, ambient: Vec3::ONE, lights: (), reflectance: Lambert };
    let stage = Material { layers: (layer, Keep(&kept)), lighting };
    stage.shade_one(surface).expect("nothing is discarded");
    kept.get()
}

/// A layer prints itself, as closures do not.
type Heights = fn(Vec2) -> f32;

/// A wave of heights, whose derivatives are known: ½ + ½ sin(2π a u) sin(2π b v).
const WAVES: [f64; 2] = [3.0, 2.0];

fn wave(uv: Vec2) -> f32 {
    let [s, t] = [f64::from(uv.x) * WAVES[0] * TAU, f64::from(uv.y) * WAVES[1] * TAU];
    (0.5 + 0.5 * s.sin() * t.sin()) as f32
}

/// The height and its derivatives.
fn exact_wave([u, v]: [f64; 2]) -> [f64; 3] {
    let [a, b] = WAVES.map(|k| TAU * k);
    let ((s, c), (t, d)) = ((a * u).sin_cos(), (b * v).sin_cos());
    [0.5 + 0.5 * s * t, 0.5 * a * c * t, 0.5 * b * s * d]
}

const STEP: f32 = 1.0 / 512.0;

/// What central differences of the wave miss of a slope: s²/6 max|h'''| and the rounding of the heights.
fn missed() -> f64 {
    let steepest = (TAU * WAVES[0]).powi(3) * 0.5;
    f64::from(STEP).powi(2) / 6.0 * steepest + 2f64.powi(-24) / f64::from(STEP)
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// On a plane, the exact normal of the graph; mirrored coordinates included.
#[test]
fn a_bump_map_bends_the_normal_of_a_plane() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut worst = 0.0;
    for k in 0..5_000 {
        let uv = Vec2::new(rng.unit() as f32, rng.unit() as f32);
        let extent = Vec2::new(rng.uniform(0.5, 4.0) as f32, rng.uniform(0.5, 4.0) as f32);
        let [low, high] = [rng.uniform(-0.5, 0.5) as f32, rng.uniform(-0.5, 0.5) as f32];
        let map = CentralDifferences { map: wave as Heights, step: Vec2::splat(STEP) };
        let v = if k % 2 == 0 { Vec3::NEG_Z } else { Vec3::Z };
        let surface = Framed { position: Vec3::ZERO, axes: [Vec3::X, v, Vec3::Y], uv };
        let (normal, _) = seen(Bump(Relief { map, low, high, extent }), Vec3::Y, surface);

        let [_, du, dv] = exact_wave(uv.as_dvec2().to_array());
        let range = f64::from(high) - f64::from(low);
        let [a, b] = [du * range / f64::from(extent.x), dv * range / f64::from(extent.y)];
        let exact = DVec3::Y - DVec3::X * a - v.as_dvec3() * b;
        let least = f64::from(extent.min_element());
        let bound = 1.5 * range.abs() * missed() / least + 1e-6;
        let error = angle(normal.as_dvec3(), exact);
        assert!(error <= bound, "{error:e} of {bound:e} at {uv}");
        worst = f64::max(worst, error / bound);
    }
    println!("a plane: {worst:.3} of the bound");
}

/// On a sphere of radius R, whose points move along the normal to R + h: the normal of that is known, of which a bump
/// map misses the share h/R of the slope.
#[test]
fn a_bump_map_bends_the_normal_of_a_sphere() {
    let mut rng = Rng::stream(run_seed(), 2);
    let mut worst = 0.0;
    const RADIUS: f64 = 2.0;
    for _ in 0..5_000 {
        let [u, v] = [rng.unit() as f32, rng.uniform(0.1, 0.9) as f32];
        // Longitude and latitude.
        let (around, up) = (f64::from(u) * TAU, (f64::from(v) - 0.5) * PI);
        let n = DVec3::new(up.cos() * around.cos(), up.sin(), -up.cos() * around.sin());
        let east = DVec3::new(-around.sin(), 0.0, -around.cos());
        let north = n.cross(east);
        let lengths = [TAU * RADIUS * up.cos(), PI * RADIUS];
        let extent = Vec2::new(lengths[0] as f32, lengths[1] as f32);
        let map = CentralDifferences { map: wave as Heights, step: Vec2::splat(STEP) };
        let (low, high) = (-0.02, 0.03);
        let axes = [east, north, n].map(|axis| axis.as_vec3());
        let position = (n * RADIUS).as_vec3();
        let surface = Framed { position, axes, uv: Vec2::new(u, v) };
        let (normal, _) = seen(Bump(Relief { map, low, high, extent }), Vec3::splat(9.0), surface);

        let [h, du, dv] = exact_wave([f64::from(u), f64::from(v)]);
        let (range, height) = (f64::from(high - low), f64::from(low) + f64::from(high - low) * h);
        let [a, b] = [du * range / lengths[0], dv * range / lengths[1]];
        let shrunk = RADIUS / (RADIUS + height);
        let exact = n - (east * a + north * b) * shrunk;
        let slope = a.hypot(b);
        let bound = slope * (shrunk - 1.0).abs() + 1.5 * range * missed() / lengths[0].min(lengths[1]) + 1e-6;
        let error = angle(normal.as_dvec3(), exact);
        assert!(error <= bound, "{error:e} of {bound:e} at {u} {v}");
        worst = f64::max(worst, error / bound);
    }
    println!("a sphere: {worst:.3} of the bound");
}

/// On a plane with a ramp, h(u) = low + (high − low) a u, the ray of sight meets the heights where
/// x (1 − k r) = x0 + k h(0) along it: a closed form.
#[test]
fn a_parallax_map_shows_where_the_ray_of_sight_meets_a_ramp() {
    let mut rng = Rng::stream(run_seed(), 3);
    let mut worst = [0.0; 3];
    for _ in 0..5_000 {
        let eye = Vec3::new(
            rng.uniform(-3.0, 3.0) as f32,
            rng.uniform(-3.0, 3.0) as f32,
            rng.uniform(1.5, 4.0) as f32,
        );
        let width = rng.uniform(0.5, 2.0) as f32;
        let mut place = || rng.uniform(-0.25, 0.25) as f32 * width;
        let position = Vec3::new(place(), place(), 0.0);
        let uv = Vec2::new(0.5 + position.x / width, 0.5 + position.y / width);
        let surface = Framed { position, axes: [Vec3::X, Vec3::Y, Vec3::Z], uv };
        // From 0.25 to 0.75 over a period, so that no ray reaches heights beyond 0 and 1.
        let (low, high) = (-0.1, 0.1);
        let relief =
            Relief { map: (|uv: Vec2| 0.25 + 0.5 * uv.x) as Heights, low, high, extent: Vec2::splat(width) };

        let to_eye = eye.as_dvec3() - position.as_dvec3();
        let width = f64::from(width);
        let slant = [to_eye.x, to_eye.y].map(|x| x / to_eye.z / width);
        let (low, range) = (f64::from(low), f64::from(high) - f64::from(low));
        let start = uv.as_dvec2();
        let height = |u: f64| low + range * (0.25 + 0.5 * u);
        // z = height(u + slant z).
        let steep = range * 0.5 * slant[0];
        let z = height(start.x) / (1.0 - steep);
        let met = [start.x + slant[0] * z, start.y + slant[1] * z];

        let shifted = |found: Vec2| {
            let [du, dv] = [f64::from(found.x) - met[0], f64::from(found.y) - met[1]];
            du.hypot(dv)
        };
        let across = slant[0].hypot(slant[1]);
        let rounding = 1e-5;
        // First order: short by the share `steep` of the shift.
        let (_, found) = seen(Parallax { relief, policy: OffsetParallax }, eye, surface);
        let bound = (steep * z).abs() * across + rounding;
        assert!(shifted(found) <= bound, "OffsetParallax: {} of {bound}", shifted(found));
        worst[0] = f64::max(worst[0], shifted(found) / bound);
        // The same, times the cosine of the view.
        let (_, found) = seen(Parallax { relief, policy: LimitedParallax }, eye, surface);
        let upright = to_eye.z / to_eye.length();
        let limited = [0, 1].map(|i| start.to_array()[i] + slant[i] * height(start.x) * upright);
        let error = (f64::from(found.x) - limited[0]).hypot(f64::from(found.y) - limited[1]);
        assert!(error <= rounding, "LimitedParallax: {error}");
        // Within a layer; linear heights are found as they are.
        let layers = 1 + rng.index(20) as u32;
        let (_, found) = seen(Parallax { relief, policy: SteepParallax { layers } }, eye, surface);
        let bound = range / f64::from(layers) * across + rounding;
        assert!(shifted(found) <= bound, "SteepParallax: {} of {bound}", shifted(found));
        worst[1] = f64::max(worst[1], shifted(found) / bound);
        let (_, found) = seen(Parallax { relief, policy: ParallaxOcclusion { layers } }, eye, surface);
        assert!(shifted(found) <= rounding, "ParallaxOcclusion: {}", shifted(found));
        worst[2] = f64::max(worst[2], shifted(found) / rounding);
    }
    println!("of their bounds: Offset {:.3}, Steep {:.3}, Occlusion {:.3}", worst[0], worst[1], worst[2]);
}

/// Where the ray of sight meets heights over a sphere of radius R, by longitude and latitude; the maps take the sphere
/// for its tangent plane. At the height z, with k the tangent of the view's slant and T that of the latitude, the ray
/// is shorter by z k³/2 times z/R, the sphere there wider by z k of it, and the grid of coordinates bends by z k² T/√3
/// of it at most: all of second order, which a quarter more covers.
#[test]
fn a_parallax_map_on_a_sphere() {
    const RADIUS: f64 = 2.0;
    const STEEPEST: f64 = 2.0;
    const NORTHMOST: f64 = 0.3 * PI;
    let mut rng = Rng::stream(run_seed(), 4);
    let mut worst = [0f64; 4];
    for turn in 0..20_000 {
        let [u, v] = [rng.uniform(0.2, 0.8) as f32, rng.uniform(0.2, 0.8) as f32];
        let (around, up) = (f64::from(u) * TAU, (f64::from(v) - 0.5) * PI);
        let n = DVec3::new(up.cos() * around.cos(), up.sin(), -up.cos() * around.sin());
        let east = DVec3::new(-around.sin(), 0.0, -around.cos());
        let north = n.cross(east);
        let lengths = [TAU * RADIUS * up.cos(), PI * RADIUS];
        let extent = Vec2::new(lengths[0] as f32, lengths[1] as f32);
        let uv = Vec2::new(u, v);
        let surface = Framed {
            position: (n * RADIUS).as_vec3(),
            axes: [east, north, n].map(|axis| axis.as_vec3()),
            uv,
        };
        let (k, direction) = (rng.uniform(0.0, STEEPEST), rng.uniform(0.0, TAU));
        let slanted = n + (east * direction.cos() + north * direction.sin()) * k;
        let eye = (n * RADIUS + slanted * rng.uniform(0.5, 5.0)).as_vec3();
        // As it is after rounding.
        let view = eye.as_dvec3() - n * RADIUS;
        let view = view / view.dot(n);
        let (low, high) = (rng.uniform(-0.03, -0.01) as f32, rng.uniform(0.01, 0.03) as f32);
        let [bottom, range] = [f64::from(low), f64::from(high) - f64::from(low)];

        let coordinates = |z: f64| {
            let q = n * RADIUS + view * z;
            let q = [(-q.z).atan2(q.x).rem_euclid(TAU) / TAU, (q.y / q.length()).asin() / PI + 0.5];
            (q, (n * RADIUS + view * z).length() - RADIUS)
        };
        // The ray's height above the sphere grows with z.
        let met = |height: &dyn Fn([f64; 2]) -> f64| {
            let (mut below, mut above) = (-0.05, 0.05);
            for _ in 0..60 {
                let middle = (below + above) / 2.0;
                let (place, radial) = coordinates(middle);
                if radial > bottom + range * height(place) { above = middle } else { below = middle }
            }
            coordinates(above)
        };
        let off = |found: Vec2, exact: [f64; 2]| {
            let [x, y] = [f64::from(found.x) - exact[0], f64::from(found.y) - exact[1]];
            (x * lengths[0]).hypot(y * lengths[1])
        };
        let flat = |z: f64| {
            1.25 * z * z / RADIUS * (k + k.powi(3) / 2.0 + k * k * up.tan().abs() / 3f64.sqrt()) + 4e-6
        };
        // A level height: 0, ½ or 1 of the range, by the root of |R n + t V| = R + z.
        let share = [0.0, 0.5, 1.0][turn % 3];
        let z = bottom + range * share;
        let square = view.length_squared();
        let along = ((RADIUS * RADIUS + square * (2.0 * RADIUS + z) * z).sqrt() - RADIUS) / square;
        let (exact, _) = coordinates(along);
        let map = [|_: Vec2| 0.0f32, |_| 0.5, |_| 1.0][turn % 3] as Heights;
        let relief = Relief { map, low, high, extent };
        let bound = flat(z);
        let simple = off(seen(Parallax { relief, policy: OffsetParallax }, eye, surface).1, exact);
        let occlusion = ParallaxOcclusion { layers: 8 };
        let layered = off(seen(Parallax { relief, policy: occlusion }, eye, surface).1, exact);
        assert!(simple.max(layered) <= bound, "level: {simple:e}, {layered:e} of {bound:e}");
        // A wave: what the place is off by, the heights are by that times their slope, and so on.
        let (exact, radial) = met(&|place| exact_wave(place)[0]);
        let relief = Relief { map: wave as Heights, low, high, extent };
        let slope = range / 2.0 * (WAVES[0] / NORTHMOST.cos()).max(2.0 * WAVES[1]) / RADIUS;
        let curvature = slope * (WAVES[0] / NORTHMOST.cos()).max(2.0 * WAVES[1]) / RADIUS;
        // Between layers a chord stands for the wave.
        let chord = k * curvature * (range / 32.0 * k).powi(2) / 8.0;
        let waved = (flat(radial) + chord) / (1.0 - slope * k);
        let occlusion = ParallaxOcclusion { layers: 32 };
        let found = off(seen(Parallax { relief, policy: occlusion }, eye, surface).1, exact);
        assert!(found <= waved, "wave: {found:e} of {waved:e}");
        let layer = range / 32.0 * k + waved;
        let stepped =
            off(seen(Parallax { relief, policy: SteepParallax { layers: 32 } }, eye, surface).1, exact);
        assert!(stepped <= layer, "steps: {stepped:e} of {layer:e}");
        let shares = [simple / bound, layered / bound, found / waved, stepped / layer];
        worst = std::array::from_fn(|i| worst[i].max(shares[i]));
    }
    println!(
        "a sphere, of the bounds: level {:.3}, {:.3}; wave {:.3}, steps {:.3}",
        worst[0], worst[1], worst[2], worst[3]
    );
    assert!(worst.iter().all(|&share| share > 0.7), "{worst:?}");
}

/// Without a parallax map, what is h above the surface is drawn below where it is: beside the ray through it, by the
/// angle whose sine is h/D sin θ, with D the distance of that place and θ the ray's angle to the normal. So from twice
/// as far it is half as much, from straight above nothing.
#[test]
fn what_a_flat_surface_misses_shrinks_with_the_distance() {
    let mut rng = Rng::stream(run_seed(), 5);
    let (mut worst, mut halves) = (0f64, [f64::INFINITY, 0.0]);
    for _ in 0..5_000 {
        let (k, turn) = (rng.uniform(0.0, 4.0), rng.uniform(0.0, TAU));
        let level = rng.uniform(0.05, 0.3) as f32;
        let relief = Relief { map: (|_: Vec2| 1.0) as Heights, low: 0.0, high: level, extent: Vec2::ONE };
        let angles = [16.0, 32.0].map(|height| {
            let eye = (DVec3::new(turn.cos() * k, turn.sin() * k, 1.0) * height).as_vec3();
            let surface = Framed { position: Vec3::ZERO, axes: [Vec3::X, Vec3::Y, Vec3::Z], uv: Vec2::ZERO };
            let (_, found) = seen(Parallax { relief, policy: OffsetParallax }, eye, surface);
            // The place under what is seen, which is where it is drawn.
            let below = found.as_dvec2().extend(0.0) - eye.as_dvec3();
            let sine = f64::from(level) / below.length() * (k / k.hypot(1.0));
            let off = angle(below, -eye.as_dvec3());
            worst = worst.max((off - sine.asin()).abs());
            off
        });
        if k > 0.1 {
            let ratio = angles[0] / angles[1];
            halves = [f64::min(halves[0], ratio), f64::max(halves[1], ratio)];
        }
    }
    println!(
        "{worst:e} radians beside the formula; from twice as far 1/{:.3} to 1/{:.3}",
        halves[0], halves[1]
    );
    assert!(worst < 1e-6 && halves[0] > 1.95 && halves[1] < 2.05, "{worst:e}, {halves:?}");
}

const FRAME: u32 = 160;

/// A sphere of radius 1 with heights on it, drawn: colours and depths.
fn sphere(map: Heights, stage: impl FragmentStage<Framed, Color = Rgba8>) -> (Vec<u32>, Vec<u32>) {
    const GRID: Grid = Grid::new(48, 24);
    let (mut positions, mut normals) = ([(); 2].map(|()| vec![Vec3::ZERO; GRID.vertices()])).into();
    let (mut uvs, mut triangles) = (vec![Vec2::ZERO; GRID.vertices()], vec![[0; 3]; GRID.triangles()]);
    let buffers = MeshBuffers {
        positions: &mut positions,
        normals: &mut normals,
        uvs: &mut uvs,
        triangles: &mut triangles,
    };
    let ball = Sphere { radius: 1.0 };
    let relief = Relief { map, low: 0.0, high: 0.2, extent: Vec2::ONE };
    displaced_mesh(&ball, &relief, GRID, buffers).expect("as many as the grid has");
    let vertices: Vec<Framed> = positions
        .iter()
        .zip(&uvs)
        .map(|(&position, &uv)| {
            let axes = ball.orthonormal_frame(uv).axes();
            Framed { position, axes: [axes.x_axis, axes.y_axis, axes.z_axis], uv }
        })
        .collect();
    let mesh = Mesh::new(&vertices, &triangles, |vertex| (vertex.position, *vertex));
    let camera = Camera::look_at(EYE, Vec3::ZERO, Vec3::Y).expect("a place");
    let view = camera.perspective(0.8, 0.1..10.0).expect("a pyramid");
    let pixels = (FRAME * FRAME) as usize;
    let (mut color, mut depth) = (vec![0; pixels], vec![1.0f32; pixels]);
    let mut target = Target::new(Rgba8888, F32, FRAME, FRAME, &mut color, &mut depth).expect("a frame");
    Pass::new(&view, &mesh, Narrow(stage)).draw_by(One, &mut target);
    (color, depth.into_iter().map(f32::to_bits).collect())
}

const EYE: Vec3 = Vec3::new(1.0, 1.5, 3.0);

/// The same samples and depths, bit for bit, in other colours; a displacement map changes all three.
#[test]
fn outline_and_depths_stay_unless_displaced() {
    let mut rng = Rng::stream(run_seed(), 6);
    let texels: Vec<[u8; 4]> = (0..64 * 64).map(|_| (rng.u64() as u32 | 0xff00_0000).to_le_bytes()).collect();
    let texture = Texture::new(format::Rgba8888, &texels, 64, 64).expect("texels");
    let image = texture.sampler(Nearest, Repeat);
    let lighting = Lighting {
        viewer: Viewer::at(Point3::new(EYE)),
        ambient: Vec3::splat(0.2),
        lights: Directional::new(Vector3::new(EYE), Vec3::splat(0.8)),
        reflectance: Lambert,
    };
    let relief =
        Relief { map: wave as Heights, low: -0.2, high: 0.2, extent: Vec2::new(TAU as f32, PI as f32) };
    let parallax = Parallax { relief, policy: OffsetParallax };
    let normals = NormalMap { map: image, encoding: NormalEncoding::Unorm, strength: 1.0 };
    let flat = Material { layers: Color(image), lighting };
    let bent = Material { layers: (parallax, Bump(relief), Color(image)), lighting };
    let mapped = Material { layers: (parallax, normals, Color(image)), lighting };

    let covered = |color: &[u32]| -> Vec<bool> { color.iter().map(|&c| c != 0).collect() };
    let differing = |a: &[u32], b: &[u32]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    let (color, depth) = sphere(|_| 0.0, flat);
    let inside = covered(&color).iter().filter(|&&covered| covered).count();
    for (changed, depths) in [sphere(|_| 0.0, bent), sphere(|_| 0.0, mapped)] {
        assert!(covered(&color) == covered(&changed) && depth == depths);
        assert!(differing(&color, &changed) > inside / 2, "the maps show");
    }
    let (raised, depths) = sphere(wave, flat);
    let outline = covered(&color).iter().zip(covered(&raised)).filter(|(a, b)| **a != *b).count();
    println!("{inside} pixels; displaced {outline} more or less, {} depths", differing(&depth, &depths));
    assert!(outline > inside / 50 && differing(&depth, &depths) > inside / 2, "{outline} of {inside}");
}
