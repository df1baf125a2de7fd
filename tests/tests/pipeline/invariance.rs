//! Invariance to the bit, which needs no oracle: under the order of a triangle's vertices, whole pixels of translation,
//! powers of two of depth or of a varying, and, for a constant, under everything.
//!
//! Grids and depth formats are values, so that triangles and scenes are a kernel each.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels and subpixels are small"
)]

use alberti::glam::Vec3;
use alberti::{
    AnyDepth, Cull, DepthFormat, Frame, Mesh, Pass, Perspective, Rgba8888, Sides, Slot, Stats, Subpixel,
    Target, View, Viewport,
};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_raster::Vertex;
use alberti_tests::probe::{Probe, Recorded, Seen, draw_widest, snapped, steps, unsnapped};

const SIZE: i64 = 64;
/// A pixel that nothing was drawn to: no depth is negative.
const NOTHING: [u32; 3] = [0, 0, (-1f32).to_bits()];

/// A picture of two interpolated numbers and their depth, too large to be printed.
#[derive(Clone, PartialEq)]
struct Picture {
    /// Bits, so that equality is that of every bit.
    pixels: Vec<[u32; 3]>,
    fragments: u64,
}

/// The picture of a triangle in `SIZE` rows from `top` on, from column `left` on.
fn picture(subpixel: Subpixel, triangle: [&Vertex<[f32; 2]>; 3], [left, top]: [i64; 2]) -> Picture {
    let width = (left + SIZE) as usize;
    let mut color = vec![0; width * SIZE as usize];
    let mut depth = vec![f32::from_bits(NOTHING[2]); color.len()];
    let size = [width as u32, (top + SIZE) as u32];
    let mut band =
        Target::band(Rgba8888, Recorded, size, top as u32, &mut color, &mut depth).expect("a frame");
    let seen = Seen::default();
    let mut shown = band.scissor(left as i32..width as i32, 0..i32::MAX);
    let mut stats = Stats::default();
    draw_widest(subpixel, &mut shown, triangle, Cull::None, |u: [f32; 2]| seen.keep(u), &mut stats);
    let depth: Vec<u32> = depth.into_iter().map(f32::to_bits).collect();
    Picture { pixels: visible(&color, &seen, &depth, width, left as usize), fragments: stats.fragments }
}

fn visible(color: &[u32], seen: &Seen<[f32; 2]>, depth: &[u32], width: usize, left: usize) -> Vec<[u32; 3]> {
    let bits = |i: usize| {
        let [u, v] = if color[i] == 0 { [0.0; 2] } else { seen.at(color[i]) };
        [u.to_bits(), v.to_bits(), depth[i]]
    };
    (0..color.len()).filter(|i| i % width >= left).map(bits).collect()
}

/// Positions in and around the picture, in 256ths of subpixels, with the zs, the q and the varying of each.
type Plain = [([i64; 2], f32, f32, [f32; 2]); 3];

fn any_triangle(subpixel: Subpixel, rng: &mut Rng) -> Plain {
    let [one, _] = steps(subpixel);
    let (around, deep) = if rng.one_in(2) { (SIZE / 4, 1e3) } else { (SIZE, 1.5) };
    [(); 3].map(|()| {
        let p = [(); 2].map(|()| match rng.index(4) {
            // On the samples' lattice, where ties are.
            0 => rng.range(-8, 2 * SIZE + 8) * one / 2,
            _ => rng.range(-around * one, (SIZE + around) * one),
        });
        // What snapping has moved, which counts in large triangles.
        let p = p.map(|c| 256 * c + rng.range(-128, 127));
        let u = [rng.uniform(-1e3, 1e3) as f32, rng.log_uniform(1e-3, 1e3)];
        (p, rng.unit() as f32, rng.log_uniform(1.0 / deep, deep), u)
    })
}

fn vertices(plain: Plain) -> [Vertex<[f32; 2]>; 3] {
    plain.map(|(p, zs, q, u)| unsnapped(p, zs, q, u))
}

#[test]
fn triangles_with_four_bits() {
    triangles(Subpixel::Sub4, 4);
}

#[test]
fn triangles_with_eight_bits() {
    triangles(Subpixel::Sub8, 8);
}

fn triangles(subpixel: Subpixel, stream: u64) {
    let mut rng = Rng::stream(run_seed(), stream);
    let mut probe = Probe::new(Recorded, subpixel);
    let picture = |triangle: [&Vertex<_>; 3], corner| picture(subpixel, triangle, corner);
    let (mut drawn, mut fragments, mut alone, mut changed) = (0, 0, 0, 0);
    for _ in 0..3_000 {
        let plain = any_triangle(subpixel, &mut rng);
        let v = vertices(plain);
        let [a, b, c] = [&v[0], &v[1], &v[2]];
        let expected = picture([a, b, c], [0, 0]);
        drawn += u64::from(expected.fragments > 0);
        fragments += expected.fragments;

        let unmoved = vertices(plain.map(|(p, zs, q, u)| (snapped(p).map(|c| 256 * c), zs, q, u)));
        changed += u64::from(picture(unmoved.each_ref(), [0, 0]) != expected);

        // A pixel drawn alone, however many are worked on at a time otherwise.
        for _ in 0..40 {
            let [x, y] = [(); 2].map(|()| rng.range(0, SIZE - 1));
            let found = probe.interpolated(&v, [x as i32, y as i32]);
            let [p, q, zs] = expected.pixels[(y * SIZE + x) as usize];
            let shown = (zs != NOTHING[2]).then_some([p, q, zs]);
            let found = found.map(|([p, q], zs)| [p, q, zs].map(f32::to_bits));
            assert_eq!(found, shown, "{plain:?} at {x}, {y}");
            alone += u64::from(shown.is_some());
        }

        for turned in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            assert!(picture(turned, [0, 0]) == expected, "another order of {plain:?}");
        }

        // Wide frames take long to look through.
        let widest = if rng.one_in(16) { 16_384 - SIZE } else { 40 };
        let far = [rng.range(0, widest), rng.range(0, 16_384 - SIZE)];
        let by = far.map(|pixels| 256 * pixels * steps(subpixel)[0]);
        let moved = vertices(plain.map(|(p, zs, q, u)| ([p[0] + by[0], p[1] + by[1]], zs, q, u)));
        assert!(picture(moved.each_ref(), far) == expected, "{plain:?} by {far:?}");

        let k = rng.range(-60, 60) as i32;
        let power = 2f32.powi(k);
        let deeper = vertices(plain.map(|(p, zs, q, u)| (p, zs, q * power, u)));
        assert!(picture(deeper.each_ref(), [0, 0]) == expected, "q of {plain:?} times 2^{k}");

        let scaled = vertices(plain.map(|(p, zs, q, u)| (p, zs, q, u.map(|u| u * power))));
        let times = |bits: u32| (f32::from_bits(bits) * power).to_bits();
        let pixels = expected.pixels.iter().map(|&[u, v, zs]| [times(u), times(v), zs]).collect();
        let expected = Picture { pixels, ..expected };
        assert!(picture(scaled.each_ref(), [0, 0]) == expected, "varyings of {plain:?} times 2^{k}");

        // Any finite number at all.
        let constant = [rng.finite_f32(), rng.finite_f32()];
        let zs = rng.unit() as f32;
        let flat = vertices(plain.map(|(p, _, q, _)| (p, zs, q, constant)));
        let bits = [constant[0].to_bits(), constant[1].to_bits(), zs.to_bits()];
        let found = picture(flat.each_ref(), [0, 0]);
        assert!(found.pixels.iter().all(|&p| p == bits || p == NOTHING), "{constant:?} over {plain:?}");
        assert_eq!(found.fragments, expected.fragments);
    }
    println!("{drawn} triangles of {fragments} fragments, {alone} drawn alone, {changed} moved");
    assert!(drawn > 2_400 && fragments > 500_000 && alone > 5_000 && changed > 300);
}

/// Triangles in eye space, some of which cross the near plane and the sides.
struct Scene {
    vertices: Vec<(Vec3, [f32; 2])>,
    triangles: Vec<[u32; 3]>,
}

impl Scene {
    fn new(rng: &mut Rng) -> Self {
        let vertices: Vec<_> = (0..24)
            .map(|_| {
                let z =
                    if rng.one_in(4) { rng.uniform(-3.0, 1.0) as f32 } else { rng.log_uniform(1.0, 30.0) };
                let [x, y] = [(); 2].map(|()| rng.uniform(-1.6, 1.6) as f32 * z.abs());
                (Vec3::new(x, y, z), [rng.uniform(-9.0, 9.0) as f32, rng.unit() as f32])
            })
            .collect();
        let triangles = (0..16).map(|_| [(); 3].map(|()| rng.index(vertices.len()) as u32)).collect();
        Self { vertices, triangles }
    }

    /// The scene times `power`, in a viewport of `SIZE` x `SIZE` pixels at (`left`, `top`).
    fn picture(
        &self,
        format: AnyDepth,
        order: [usize; 3],
        power: f32,
        [left, top]: [i64; 2],
        sides: Sides,
    ) -> (Picture, Stats) {
        let triangles: Vec<[u32; 3]> = self.triangles.iter().map(|t| order.map(|k| t[k])).collect();
        let size = SIZE as u32;
        let seen = Seen::default();
        let projection = Perspective::new(1.0, 1.0, 0.5 * power, 20.0 * power).expect("a pyramid");
        let view = View::new(Frame::IDENTITY, projection);
        let viewport = Viewport::new(left as i32, top as i32, size, size).expect("a viewport");
        let place = |&(p, u): &(Vec3, [f32; 2])| (p * power, u);
        let mesh = Mesh::new(&self.vertices, &triangles, place);
        let width = (left.max(0) + SIZE) as usize;
        let mut color = vec![0; width * SIZE as usize];
        let mut depth = vec![format.farthest(); color.len()];
        let [first, rows] = [top.max(0) as u32, (top.max(0) + SIZE) as u32];
        let mut band = Target::band(Rgba8888, format, [width as u32, rows], first, &mut color, &mut depth)
            .expect("a frame");
        let mut slots = [Slot::EMPTY; 24];
        let stats = Pass::new(&view, &mesh, |u: [f32; 2]| seen.keep(u))
            .viewport(viewport)
            .cull(Cull::None)
            .sides(sides)
            .slots(&mut slots)
            .draw_counted(&mut band);
        let pixels = visible(&color, &seen, &depth, width, left.max(0) as usize);
        (Picture { pixels, fragments: stats.fragments }, stats)
    }
}

#[test]
fn scenes_do_not_depend_on_order_place_or_unit() {
    let mut rng = Rng::stream(run_seed(), 1);
    let (mut clipped, mut fragments) = (0, 0);
    for i in 0..1_200 {
        let scene = Scene::new(&mut rng);
        // Clipping against the guard band depends on where it is as seen from the viewport, the sides do not.
        let sides = if i % 2 == 0 { Sides::Cube } else { Sides::GuardBand };
        let (expected, stats) = scene.picture(AnyDepth::F32Reversed, [0, 1, 2], 1.0, [0, 0], sides);
        clipped += stats.clipped;
        fragments += stats.fragments;
        for order in [[1, 2, 0], [2, 0, 1]] {
            let turned = scene.picture(AnyDepth::F32Reversed, order, 1.0, [0, 0], sides);
            assert!(turned == (expected.clone(), stats), "scene {i}, order {order:?}");
        }
        let power = 2f32.powi(rng.range(-40, 40) as i32);
        let scaled = scene.picture(AnyDepth::F32Reversed, [0, 1, 2], power, [0, 0], sides);
        assert!(scaled == (expected.clone(), stats), "scene {i} times {power:e}");
        let [forward, scaled] =
            [1.0, power].map(|power| scene.picture(AnyDepth::F32, [0, 1, 2], power, [0, 0], sides).0);
        assert!(scaled == forward, "scene {i} with forward depth times {power:e}");

        if sides == Sides::Cube {
            let corner = [rng.range(0, 4_000), rng.range(0, 16_384 - SIZE)];
            let moved = scene.picture(AnyDepth::F32Reversed, [0, 1, 2], 1.0, corner, sides);
            assert!(moved == (expected.clone(), stats), "scene {i} at {corner:?}");
        }
    }
    println!("{clipped} clipped, {fragments} fragments");
    assert!(clipped > 2_000 && fragments > 1_000_000);
}
