//! One triangle on the screen against integers and rationals: which samples it covers, and with what.

use crate::bits::Bits;
use alberti_math::lanes::One;
use alberti_math::{GUARD_PIXELS, Rgba8, Subpixel};
use alberti_oracle::coverage::{Triangle, area2, covers};
use alberti_oracle::rational::{error_in_eps, hyperbolic, linear};
use alberti_raster::{
    Affine, Cull, Exact, FixedPoint, Interpolation, Lines, NoDepth, Paint, Planes, Rgba8888, Target,
};
use alberti_tests::for_widest;
use alberti_tests::probe::{Recorded, Seen, bare, vertex};

const WIDTH: u32 = 28;
const HEIGHT: u32 = 20;

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    let subpixel = bits.pick(&[Subpixel::Sub4, Subpixel::Sub8]);
    let tri = corners(&mut bits, subpixel);
    let cull = bits.pick(&[Cull::None, Cull::Back, Cull::Front]);
    coverage(subpixel, tri, cull, &mut bits);
    if area2(tri) != 0 {
        attributes(subpixel, tri, &mut bits);
    }
}

/// Three places: near the frame, far from it, on samples, and on lines through samples.
fn corners(bits: &mut Bits<'_>, subpixel: Subpixel) -> Triangle {
    let one = 1i64 << subpixel.bits();
    let guard = i64::from(GUARD_PIXELS) * one - 1;
    let sample = [bits.between(0, i64::from(WIDTH) - 1), bits.between(0, i64::from(HEIGHT) - 1)];
    let sample = sample.map(|pixel| pixel * one + one / 2);
    [(); 3].map(|()| {
        let place = match bits.byte() & 3 {
            0 => [bits.between(-one, 30 * one), bits.between(-one, 22 * one)],
            1 => [bits.between(-guard, guard), bits.between(-guard, guard)],
            2 => [bits.between(0, 31) * one + one / 2, bits.between(0, 23) * one + one / 2],
            _ => {
                // A line through a sample, so many steps along, perhaps a subpixel beside.
                let [dx, dy] = [bits.between(-9, 9), bits.between(-9, 9)];
                let steps = bits.between(-900, 900);
                [sample[0] + steps * dx + bits.between(-1, 1), sample[1] + steps * dy + bits.between(-1, 1)]
            }
        };
        place.map(|c| c.clamp(-guard, guard))
    })
}

fn samples(subpixel: Subpixel) -> impl Iterator<Item = [i64; 2]> {
    let one = 1i64 << subpixel.bits();
    let center = move |c: u32| i64::from(c) * one + one / 2;
    (0..HEIGHT).flat_map(move |y| (0..WIDTH).map(move |x| [center(x), center(y)]))
}

/// One lane, the widest, integers and straight lines agree with the oracle.
fn coverage(subpixel: Subpixel, tri: Triangle, cull: Cull, bits: &mut Bits<'_>) {
    // Clockwise on the screen, where y goes down, is a back face.
    let kept = match cull {
        Cull::None => true,
        Cull::Back => area2(tri) < 0,
        Cull::Front => area2(tri) > 0,
    };
    let [a, b, c] = bare(tri);
    let rows = bits.between(1, i64::from(HEIGHT)) as usize;
    let draw = |way: u8| {
        let mut color = vec![0u32; (WIDTH * HEIGHT) as usize];
        let mut depth = vec![(); color.len()];
        let mut target =
            Target::new(Rgba8888, NoDepth, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
        let white = |()| Some(Rgba8::WHITE);
        let vertices = [&a, &b, &c];
        match way {
            0 => Paint { stage: white, interpolation: Exact, subpixel, cull }.triangle(
                One,
                &mut target,
                vertices,
                &mut (),
            ),
            1 => {
                let paint = Paint { stage: white, interpolation: Exact, subpixel, cull };
                for_widest!(lanes => paint.triangle(lanes, &mut target, vertices, &mut ()));
            }
            2 => Paint { stage: white, interpolation: FixedPoint(Affine), subpixel, cull }.triangle(
                One,
                &mut target,
                vertices,
                &mut (),
            ),
            _ => {
                let paint = Paint { stage: white, interpolation: Exact, subpixel, cull };
                for mut band in target.split(rows) {
                    for_widest!(lanes => paint.triangle(lanes, &mut band, vertices, &mut ()));
                }
            }
        }
        color
    };
    for way in 0..4 {
        for (sample, pixel) in samples(subpixel).zip(draw(way)) {
            assert_eq!(pixel != 0, kept && covers(tri, sample), "{tri:?} at {sample:?}, by {way}");
        }
    }
}

fn attributes(subpixel: Subpixel, tri: Triangle, bits: &mut Bits<'_>) {
    // Inverses of depths in ratios up to 2^30, screen depths, and a varying.
    let q = [(); 3].map(|()| f32::from(u16::from(bits.byte()) + 256) * 2f32.powi(-(bits.below(31) as i32)));
    let zs = [(); 3].map(|()| f32::from(u16::from_le_bytes(bits.bytes())) / 65535.0);
    let u = [(); 3].map(|()| bits.finite());
    if u.iter().any(|u| u.abs() > 1e23 || (*u != 0.0 && u.abs() < 1e-23)) {
        return;
    }
    let vertices = [0, 1, 2].map(|k| vertex(tri[k], zs[k], q[k], u[k]));
    exactly(subpixel, tri, [q, zs, u], &vertices);
    let [least, most] =
        [u.iter().fold(f32::MAX, |a, b| a.min(*b)), u.iter().fold(f32::MIN, |a, b| a.max(*b))];
    let within = |found: f32| assert!(found >= least && found <= most, "{found} is beyond {u:?}");
    stay(subpixel, &vertices, Planes, within);
    stay(subpixel, &vertices, Lines::bounded(bits.float()), within);
    stay(subpixel, &vertices, Affine, within);
}

/// No policy leaves the range of the vertices.
fn stay(
    subpixel: Subpixel,
    vertices: &[alberti_raster::Vertex<f32>; 3],
    interpolation: impl Interpolation,
    within: impl Fn(f32),
) {
    let stage = |value: f32| {
        within(value);
        Some(Rgba8::WHITE)
    };
    let mut color = vec![0u32; (WIDTH * HEIGHT) as usize];
    let mut depth = vec![1.0f32; color.len()];
    let mut target = Target::new(Rgba8888, Recorded, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let [a, b, c] = vertices;
    Paint { stage, interpolation, subpixel, cull: Cull::None }.triangle(One, &mut target, [a, b, c], &mut ());
    assert!(depth.iter().all(|zs| (0.0..=1.0).contains(zs)));
}

/// The exact policy keeps its bounds against rationals.
fn exactly(
    subpixel: Subpixel,
    tri: Triangle,
    [q, zs, u]: [[f32; 3]; 3],
    vertices: &[alberti_raster::Vertex<f32>; 3],
) {
    let seen = Seen::default();
    let stage = |value: f32| seen.keep(value);
    let mut color = vec![0u32; (WIDTH * HEIGHT) as usize];
    let mut depth = vec![2.0f32; color.len()];
    let mut target = Target::new(Rgba8888, Recorded, WIDTH, HEIGHT, &mut color, &mut depth).expect("a frame");
    let [a, b, c] = vertices;
    let paint = Paint { stage, interpolation: Exact, subpixel, cull: Cull::None };
    for_widest!(lanes => paint.triangle(lanes, &mut target, [a, b, c], &mut ()));
    let most = |of: [f32; 3]| of.iter().fold(0.0, |m, u| f64::max(m, f64::from(u.abs())));
    let (largest, deepest) = (most(u), most(zs));
    // Of large triangles it is the plane before snapping that counts.
    let extent =
        |k: usize| tri.iter().map(|p| p[k]).max().unwrap_or(0) - tri.iter().map(|p| p[k]).min().unwrap_or(0);
    let is_large = extent(0).max(extent(1)) >= 64 << subpixel.bits();
    let (bound, more) = if is_large { (13.0, 4.0) } else { (9.0, 0.0) };
    let covered = samples(subpixel).zip(color.iter().zip(&depth)).filter(|(_, (pixel, _))| **pixel != 0);
    // Rationals take a while.
    for (sample, (&pixel, &stored)) in covered.step_by(37) {
        let exact = hyperbolic(tri, sample, q, u);
        if largest > 0.0 {
            let error = error_in_eps(seen.at(pixel), &exact, largest).abs();
            assert!(error <= bound, "{error} ε: {tri:?} at {sample:?}, {q:?}, {u:?}");
        }
        let exact = linear(tri, sample, zs);
        let size = alberti_oracle::rational::to_f64(&exact).abs();
        if size > 0.0 {
            let error = error_in_eps(stored, &exact, size).abs();
            assert!(
                error <= 6.0 + more * deepest / size,
                "{error} ε in depth: {tri:?} at {sample:?}, {zs:?}"
            );
        }
    }
}
