//! The cost of filters and maps: one scene of 1280x720, a receding floor between two tilted walls, read in many ways.
//!
//! Before a way is timed, its picture is held against the same drawn one sample at a time, which must not differ in a
//! bit; the plain filters also against `f64`, from rays, at some hundred pixels. Figures are for written pixels, of
//! drawing alone: without the clear. `PICTURES=folder` keeps the pictures there, as PPM files.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels, texels and bytes"
)]

use alberti::glam::{DVec2, DVec3, Vec2, Vec3};
use alberti::lanes::{Floating, Machine, One};
use alberti::raster::{PerRun, PerTriangle};
use alberti::shaders::material::{
    Color, Directional, Emission, Framed, Gloss, InSpace, Lambert, Lighting, LinearLight, Material,
    NormalMap, Occlusion, Parallax, Placed, Shared, Specular, Together, Viewer, Wetness,
};
use alberti::shaders::{Differentiated, Unlit, material};
use alberti::texture::format::Normals;
use alberti::texture::surface::{LimitedParallax, NormalEncoding::Unorm, Relief};
use alberti::texture::{
    Anisotropic, Bilinear, Minify, Mipmap, Nearest, NearestLevel, PowerOfTwo, Repeat, Texture, Trilinear,
    mipmap,
};
use alberti::{
    Always, Cull, F32, FragmentStage, Frame, Mesh, Pass, Perspective, Point3, Rgba8, Rgba8888, Slot, Stats,
    Target, Varying, Vector3, View, for_lanes,
};
use alberti_benches::stones::{SIDE, Stones, bilinear, nearest, trilinear};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::path::Path;
use std::time::Duration;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
const PIXELS: usize = (WIDTH * HEIGHT) as usize;
const FAR: f32 = 30.0;

/// A corner of a plane, in the space of the eye: x right, y up, z away.
#[derive(Clone, Copy, Debug)]
struct Corner {
    position: Vec3,
    axes: [Vec3; 3],
    uv: Vec2,
}

/// A plane through `origin` with a direction across; all of them go away along z.
#[derive(Clone, Copy, Debug)]
struct Wall {
    origin: Vec3,
    across: Vec3,
    width: f32,
}

/// The floor and two walls, which lean outwards.
const WALLS: [Wall; 3] = [
    Wall { origin: Vec3::new(-1.5, -1.0, 0.0), across: Vec3::new(1.0, 0.0, 0.0), width: 3.0 },
    Wall { origin: Vec3::new(-1.5, -1.0, 0.0), across: Vec3::new(-0.6, 0.8, 0.0), width: 60.0 },
    Wall { origin: Vec3::new(1.5, -1.0, 0.0), across: Vec3::new(0.6, 0.8, 0.0), width: 60.0 },
];

/// Texture coordinates a unit of length.
const PER_UNIT: f32 = 0.5;

impl Wall {
    fn corners(&self) -> [Corner; 4] {
        let along = Vec3::Z;
        let normal = self.across.cross(along) * if self.across.cross(along).y < 0.0 { -1.0 } else { 1.0 };
        [[0.0, 0.4], [self.width, 0.4], [self.width, FAR], [0.0, FAR]].map(|[s, t]| Corner {
            position: self.origin + self.across * s + along * t,
            axes: [self.across, along, normal],
            uv: Vec2::new(s, t) * PER_UNIT,
        })
    }

    /// Where a ray from the eye meets it, if it does: the distance along z, and the texture coordinates.
    fn meets(&self, ray: DVec3) -> Option<(f64, DVec2)> {
        let (origin, across) = (self.origin.as_dvec3(), self.across.as_dvec3());
        let normal = across.cross(DVec3::Z);
        let z = origin.dot(normal) / ray.dot(normal);
        let s = (ray * z - origin).dot(across);
        let inside = z > 0.4 && z < f64::from(FAR) && s > 0.0 && s < f64::from(self.width);
        inside.then(|| (z, DVec2::new(s, z) * f64::from(PER_UNIT)))
    }
}

/// The texture coordinates at a place of the frame, in pixels.
fn traced(x: f64, y: f64) -> Option<(usize, DVec2)> {
    let half = [f64::from(WIDTH) / 2.0, f64::from(HEIGHT) / 2.0];
    let ray = DVec3::new((x - half[0]) / half[1], (half[1] - y) / half[1], 1.0);
    let met = WALLS.iter().enumerate().filter_map(|(i, wall)| Some((i, wall.meets(ray)?)));
    met.min_by(|a, b| a.1.0.total_cmp(&b.1.0)).map(|(i, (_, uv))| (i, uv))
}

fn mip(texels: &[[u8; 4]]) -> Mipmap<'_, Rgba8888, PowerOfTwo> {
    Mipmap::new(Rgba8888, texels, SIDE, SIDE).expect("levels").power_of_two().expect("a power of two")
}

/// The scene, ready to be drawn.
struct Scene {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
    view: View,
    color: Vec<u32>,
    depth: Vec<f32>,
}

impl Scene {
    fn new() -> Self {
        let (angle, aspect) = (std::f32::consts::FRAC_PI_2, WIDTH as f32 / HEIGHT as f32);
        let projection = Perspective::new(angle, aspect, 0.1, 100.0);
        Self {
            corners: WALLS.iter().flat_map(Wall::corners).collect(),
            triangles: (0..3).flat_map(|i| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| 4 * i + k))).collect(),
            view: View::new(Frame::IDENTITY, projection.expect("a perspective")),
            color: vec![0; PIXELS],
            depth: vec![1.0; PIXELS],
        }
    }

    /// Colours alone: the depth of all is equal from frame to frame.
    fn draw<V: Varying>(
        &mut self,
        lanes: impl Floating,
        vertex_stage: impl Fn(&Corner) -> (Vec3, V),
        fragment_stage: impl FragmentStage<V, Color = Rgba8>,
    ) -> u64 {
        let mesh = Mesh::new(&self.corners, &self.triangles, vertex_stage);
        let (color, depth) = (&mut self.color, &mut self.depth);
        let mut target =
            Target::new(Rgba8888, Always(F32), WIDTH, HEIGHT, color, depth).expect("buffers that fit");
        let mut stats = Stats::default();
        let mut slots = [Slot::EMPTY; 12];
        Pass::new(&self.view, &mesh, fragment_stage).cull(Cull::None).slots(&mut slots).count_by(
            lanes,
            &mut target,
            &mut stats,
        );
        stats.written
    }
}

fn bare(c: &Corner) -> (Vec3, Vec2) {
    (c.position, c.uv)
}

fn placed(c: &Corner) -> (Vec3, Placed) {
    (c.position, Placed { position: c.position, normal: c.axes[2], uv: c.uv })
}

fn framed(c: &Corner) -> (Vec3, Framed) {
    (c.position, Framed { position: c.position, axes: c.axes, uv: c.uv })
}

/// The colours that a filter ought to show of places, in `f64`.
type Ideal<'a> = &'a dyn Fn(DVec2, f64) -> [f64; 3];

/// How many of some hundred pixels are off by more than 4 of 255, of which how many were looked at: away from the
/// corners between the walls, and not beyond their far ends.
fn off(color: &[u32], ideal: Ideal<'_>) -> (usize, usize) {
    let (mut off, mut count) = (0, 0);
    for (x, y) in (7..WIDTH).step_by(41).flat_map(|x| (5..HEIGHT).step_by(37).map(move |y| (x, y))) {
        let at = |dx: f64, dy: f64| traced(f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy);
        let around = [at(0.0, 0.0), at(0.01, 0.0), at(0.0, 0.01), at(3.0, 3.0), at(-3.0, -3.0)];
        let [Some((wall, uv)), Some((_, right)), Some((_, below)), ..] = around else { continue };
        if around.iter().any(|place| place.is_none_or(|(other, _)| other != wall)) {
            continue;
        }
        let length = |other: DVec2| ((other - uv) * 100.0 * f64::from(SIDE)).length();
        let ideal = ideal(uv, length(right).max(length(below)).log2());
        let [r, g, b, _] = color[(y * WIDTH + x) as usize].to_ne_bytes();
        let wrong = [r, g, b].iter().zip(ideal).any(|(&got, ideal)| (f64::from(got) - ideal).abs() > 4.0);
        off += usize::from(wrong);
        count += 1;
    }
    (off, count)
}

/// Writes a picture in the Portable Pixmap format.
fn keep(folder: &Path, name: &str, color: &[u32]) {
    let mut file = format!("P6\n{WIDTH} {HEIGHT}\n255\n").into_bytes();
    file.extend(color.iter().flat_map(|p| {
        let [r, g, b, _] = p.to_ne_bytes();
        [r, g, b]
    }));
    std::fs::write(folder.join(name).with_extension("ppm"), file).expect("a file");
}

fn surface(criterion: &mut Criterion) {
    let (maps, mut scene) = (Stones::new(), Scene::new());
    let base = Texture::new(Rgba8888, &maps.color[..(SIDE * SIDE) as usize], SIDE, SIDE).expect("a texture");
    let base = base.power_of_two().expect("a power of two");
    let color = mip(&maps.color).sampler(Trilinear, Repeat);
    let normal =
        NormalMap { map: mip(&maps.normal).sampler(Trilinear, Repeat), encoding: Unorm, strength: 1.0 };
    let together = Together {
        maps: Mipmap::together([mip(&maps.color), mip(&maps.normal)])
            .expect("one size")
            .sampler(Trilinear, Repeat),
        layers: (Color(Shared), NormalMap { map: Shared, encoding: Unorm, strength: 1.0 }),
    };
    let other = mip(&maps.other).sampler(Trilinear, Repeat);
    let height = Texture::new(alberti::texture::format::L8, &maps.height, SIDE, SIDE).expect("a texture");
    let height = height.power_of_two().expect("a power of two").sampler(Bilinear, Repeat);
    let extent = Vec2::splat(1.0 / PER_UNIT);
    let parallax =
        Parallax { relief: Relief { map: height, low: -0.05, high: 0.0, extent }, policy: LimitedParallax };
    let viewer = Viewer::at(Point3::new(Vec3::ZERO));
    let lights = Directional::new(Vector3::new(Vec3::new(0.3, 0.8, -0.5)), Vec3::splat(0.8));
    let ambient = Vec3::splat(0.2);
    let lit = Lighting { viewer, ambient, lights, reflectance: Lambert };
    let mirrored = Lighting { viewer, ambient, lights, reflectance: material::BlinnPhong([10, 200]) };
    let all = (
        parallax,
        Color(color),
        normal,
        Specular(other),
        Gloss(other),
        Wetness(other),
        Occlusion { map: other, strength: 1.0 },
        Emission(Rgba8::from_rgb24(0x04_02_00)),
    );

    let mut group = criterion.benchmark_group("surface");
    let machine = Machine::all().next().expect("every machine has lanes");
    macro_rules! rows {
        ($($name:literal: $vertex:expr, $fragment:expr $(, $ideal:expr)?;)+) => {$({
            let written = scene.draw(One, $vertex, $fragment);
            let alone = scene.color.clone();
            scene.color.fill(0);
            for_lanes!(machine, lanes => scene.draw(lanes, $vertex, $fragment));
            assert!(scene.color == alone, "{}: one lane draws another picture", $name);
            let distinct = alone.iter().collect::<std::collections::HashSet<_>>().len();
            assert!(distinct > 300, "{}: {distinct} colours are no picture", $name);
            eprintln!("{}: {written} pixels, {distinct} colours", $name);
            $({
                let (off, count) = off(&scene.color, &$ideal);
                eprintln!("    {off} of {count} pixels off from f64");
                assert!(count > 300 && off * 50 <= count, "{}: {off} of {count} are off", $name);
            })?
            if let Some(folder) = std::env::var_os("PICTURES") {
                keep(Path::new(&folder), $name, &alone);
            }
            group.throughput(Throughput::Elements(written));
            group.bench_function($name, |bencher| {
                bencher.iter(|| for_lanes!(machine, lanes => scene.draw(lanes, $vertex, $fragment)));
            });
        })+};
    }
    let trilinear_unlit = Unlit(color);
    rows! {
        "nearest": bare, Unlit(base.sampler(Nearest, Repeat)), |uv, _| nearest(&maps.color, uv);
        "bilinear": bare, Unlit(base.sampler(Bilinear, Repeat)), |uv, _| bilinear(&maps.color, 0, uv);
        "nearest-mip": bare, Unlit(mip(&maps.color).sampler(Minify { min: NearestLevel(Nearest), mag: Nearest }, Repeat));
        "bilinear-mip": bare, Unlit(mip(&maps.color).sampler(Minify { min: NearestLevel(Bilinear), mag: Bilinear }, Repeat));
        "trilinear": bare, trilinear_unlit, |uv, lambda| trilinear(&maps.color, uv, lambda);
        "trilinear-per-span": bare, Differentiated::by(PerRun, trilinear_unlit);
        "trilinear-per-triangle": bare, Differentiated::by(PerTriangle, trilinear_unlit);
        "anisotropic-4": bare, Unlit(mip(&maps.color).sampler(Anisotropic { probes: 4, filter: Trilinear }, Repeat));
        "anisotropic-8": bare, Unlit(mip(&maps.color).sampler(Anisotropic { probes: 8, filter: Trilinear }, Repeat));
        "anisotropic-16": bare, Unlit(mip(&maps.color).sampler(Anisotropic { probes: 16, filter: Trilinear }, Repeat));
        "lights": placed, Material { layers: (Color(color),), lighting: lit };
        "lights, in light": placed,
            InSpace { surface: Material { layers: (Color(color),), lighting: lit }, space: LinearLight };
        "normal-map": framed, Material { layers: (Color(color), normal), lighting: lit };
        "normal-map, together": framed, Material { layers: together, lighting: lit };
        "parallax": framed, Material { layers: (parallax, Color(color), normal), lighting: lit };
        "all": framed, Material { layers: all, lighting: mirrored };
    }
    group.finish();
}

/// Mip maps of an image whose sides are powers of two, of one whose sides are even, of one of which each level has odd
/// sides, and of normals. The last texel is the mean of all light, or of all vectors, in `f64`.
fn mip_maps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mip-maps");
    for side in [1024_u32, 1000, 1023] {
        let area = (side * side) as usize;
        let mut texels = vec![[0; 4]; mipmap::texel_count(side, side)];
        for (texel, k) in texels.iter_mut().zip(0..area as u32) {
            let [r, g, b, _] = k.wrapping_mul(0x9e37_79b1).to_le_bytes();
            *texel = [r, g, b, 255];
        }
        mipmap::build(Rgba8888, &mut texels, side, side).expect("room for all levels");
        let last = texels.last().copied().unwrap_or_default();
        for (channel, found) in last.into_iter().enumerate().take(3) {
            let sum: f64 = texels[..area].iter().map(|texel| light(texel[channel])).sum();
            let [below, above] = [found.saturating_sub(1), found.saturating_add(1)].map(light);
            let mean = sum / area as f64;
            assert!(below < mean && mean < above, "{side}: {found} in channel {channel}, of light {mean}");
        }
        group.throughput(Throughput::Elements(area as u64));
        group.bench_function(format!("{side}x{side}"), |bencher| {
            bencher.iter(|| mipmap::build(Rgba8888, &mut texels, side, side));
        });
        mipmap::build(Normals(Rgba8888), &mut texels, side, side).expect("room for all levels");
        let sum = texels[..area].iter().fold(DVec3::ZERO, |sum, &[x, y, z, _]| {
            sum + DVec3::from([x, y, z].map(|byte| 2.0 * f64::from(byte) / 255.0 - 1.0))
        });
        let [x, y, z, _] = texels.last().copied().unwrap_or_default().map(f64::from);
        let right = (sum.normalize() + 1.0) * 127.5;
        assert!((DVec3::new(x, y, z) - right).abs().max_element() < 0.51, "{side}: {x} {y} {z} for {right}");
        group.bench_function(format!("{side}x{side}, normals"), |bencher| {
            bencher.iter(|| mipmap::build(Normals(Rgba8888), &mut texels, side, side));
        });
    }
    group.finish();
}

/// The light of a byte of sRGB.
fn light(byte: u8) -> f64 {
    let x = f64::from(byte) / 255.0;
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(2));
    targets = surface, mip_maps
}
criterion_main!(benches);
