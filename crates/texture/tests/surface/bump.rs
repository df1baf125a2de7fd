//! Bump maps, against the normals of the surfaces that they stand for.

use crate::support::{EPS, angle, axes, vec2, vec3};
use alberti_math::lanes::{One, OneFixed};
use alberti_math::{Frame, Object, Point3, Q16, Rgba8, Vector3};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::format::{Indexed8, L8, L16};
use alberti_texture::surface::{
    HeightMap, Parametric, Relief, Sphere, Tangent, bilinear_height, bilinear_height_lanes, bump,
    frame_of_derivatives, normal_of_slope,
};
use alberti_texture::{Bilinear, Border, Clamp, Mirror, Nearest, Repeat, Texture, Wrap};
use glam::{DVec2, DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

#[test]
fn normals_of_slopes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 3];
    for _ in 0..500_000 {
        let slope = vec2(&mut rng, 1.0).signum()
            * Vec2::new(rng.log_uniform(1e-30, 1e17), rng.log_uniform(1e-30, 1e17));
        let found = normal_of_slope(slope).coords.as_dvec3();
        let exact = DVec3::new((-slope.x).into(), (-slope.y).into(), 1.0).normalize();
        for i in 0..3 {
            let error = (found[i] - exact[i]).abs();
            worst[0] =
                worst[0].max(if error <= 2f64.powi(-126) { 0.0 } else { error / exact[i].abs() / EPS });
        }
        worst[1] = worst[1].max((found.length() - 1.0).abs() / EPS);
        worst[2] = worst[2].max(angle(found, exact) / EPS);
    }
    println!("components {:.3}ε, lengths {:.3}ε, directions {:.3}ε", worst[0], worst[1], worst[2]);
    assert!(worst[0] <= 4.0 && worst[1] <= 3.1 && worst[2] <= 2.0);
    for slope in [Vec2::NAN, Vec2::new(f32::INFINITY, 0.0), Vec2::splat(1e30)] {
        assert_eq!(normal_of_slope(slope).coords, Vec3::Z);
    }
}

/// Those of a map that was given no step: 2^-10 of a closure, a texel of a sampler.
#[test]
fn maps_have_slopes() {
    let (mut rng, mut worst) = (Rng::new(run_seed()), 0.0f64);
    let wave = |uv: Vec2| (0.5 + 0.5 * (TAU * f64::from(uv.x)).sin() * (TAU * f64::from(uv.y)).cos()) as f32;
    let step = 2f64.powi(-10);
    let bound = step * step / 6.0 * TAU.powi(3) / 2.0 + EPS / step + 4.0 * EPS * TAU / 2.0;
    for _ in 0..100_000 {
        let uv = vec2(&mut rng, 1.0);
        let [(sin_u, cos_u), (sin_v, cos_v)] = [uv.x, uv.y].map(|c| (TAU * f64::from(c)).sin_cos());
        let exact = [0.5 * TAU * cos_u * cos_v, -0.5 * TAU * sin_u * sin_v];
        let found = wave.slopes_lanes(One, uv.to_array()).map(f64::from);
        worst = (0..2).fold(worst, |worst, i| worst.max((found[i] - exact[i]).abs() / bound));
    }
    println!("slopes of closures: {worst:.3} of their bound");
    assert!((0.5..=1.0).contains(&worst), "{worst}");

    // Rising by 1000 and 3000 of 65535 a texel, of which there are 8 and 4; the upper row is the first.
    let texels: Vec<u16> = (0..32u16).map(|i| i % 8 * 1000 + (3 - i / 8) * 3000).collect();
    let ramp = Texture::new(L16, &texels, 8, 4).unwrap();
    let exact = [8.0 * 1000.0 / 65535.0, 4.0 * 3000.0 / 65535.0];
    let close = |found: [f32; 2]| (0..2).all(|i| (f64::from(found[i]) - exact[i]).abs() < 1e-5 * exact[i]);
    // In the middle of a texel, and between texels, where weights are whole 256ths.
    for uv in [[0.3125, 0.375], [0.5, 0.5], [0.40625, 0.5625]] {
        assert!(close(ramp.sampler(Bilinear, Clamp).slopes_lanes(One, uv)), "{uv:?}");
    }
    assert!(close(ramp.sampler(Nearest, Clamp).slopes_lanes(One, [0.3125, 0.375])));
}

/// h = (1 + sin 2πu cos 2πv)/2, whose third derivatives are at most (2π)³/2.
#[test]
fn central_differences_keep_their_bound() {
    let wave = |uv: Vec2| {
        let [u, v] = [uv.x, uv.y].map(|c| TAU * f64::from(c));
        (0.5 + 0.5 * u.sin() * v.cos()) as f32
    };
    let mut rng = Rng::new(run_seed());
    let mut shares = Vec::new();
    for exponent in [-12, -8, -6, -4] {
        let mut worst = 0.0f64;
        for _ in 0..50_000 {
            let (low, high) = (rng.uniform(-2.0, 0.0) as f32, rng.uniform(0.1, 2.0) as f32);
            let extent = Vec2::new(rng.log_uniform(0.1, 10.0), rng.log_uniform(0.1, 10.0));
            let relief = Relief { map: wave, low, high, extent };
            let uv = vec2(&mut rng, 1.0);
            let step = 2f32.powi(exponent);
            let found = relief.slope(uv, Vec2::splat(step));
            let [u, v] = [uv.x, uv.y].map(|c| TAU * f64::from(c));
            let (range, s) = (f64::from(high) - f64::from(low), f64::from(step));
            let exact =
                DVec2::new(u.cos() * v.cos(), -u.sin() * v.sin()) * (TAU / 2.0 * range) / extent.as_dvec2();
            for i in 0..2 {
                let bend = range / f64::from(extent[i]) * (s * s / 6.0 * TAU.powi(3) / 2.0 + EPS / s);
                let error = (f64::from(found[i]) - exact[i]).abs();
                worst = worst.max(error / (bend + 4.0 * EPS * exact[i].abs()));
            }
            let height = f64::from(low) + range * f64::from(wave(uv));
            let error = (f64::from(relief.height(uv)) - height).abs();
            assert!(error <= 4.0 * EPS * f64::from(low.abs().max(high)), "{error}");
            let normal = relief.normal(uv, Vec2::splat(step));
            assert_eq!(normal, normal_of_slope(found));
        }
        shares.push((exponent, worst));
    }
    println!("shares of the bound by step 2^k: {shares:?}");
    assert!(shares.iter().all(|&(_, share)| share <= 1.0 && share > 0.3));
}

/// Three frames: of any derivatives, and of heights over a plane, whose normal is known without Blinn's formula.
#[test]
fn bumps_on_planes_and_spheres() {
    let mut rng = Rng::new(run_seed());
    let mut worst = 0.0f64;
    for _ in 0..200_000 {
        let (du, dv) = (vec3(&mut rng, 1.0), vec3(&mut rng, 1.0) * rng.log_uniform(0.01, 100.0));
        let frame = frame_of_derivatives(Point3::new(Vec3::ZERO), Vector3::new(du), Vector3::new(dv));
        let gradient = vec2(&mut rng, 1.0) * rng.log_uniform(1e-3, 1e3);
        let [x, y, z] = axes(frame).map(|axis| axis.as_dvec3());
        let n = z.normalize();
        let found = bump(&frame, gradient).coords.as_dvec3();
        // The raised derivatives; the frame's z is rounded, which shows where x and y are near parallel.
        let raised = (x + n * f64::from(gradient.x)).cross(y + n * f64::from(gradient.y));
        let terms = z.length() + f64::from(gradient.length()) * x.length().max(y.length());
        if raised.length() > 0.1 * terms && z.length() > 0.1 * x.length() * y.length() {
            worst = worst.max(angle(found, raised) / EPS);
        }
    }
    println!("directions {worst:.3}ε");
    assert!(worst <= 2.0);

    // A higher sphere is a sphere: the gradient of a constant bends nothing.
    let sphere = Sphere { radius: 2.0 };
    for _ in 0..1000 {
        let uv = Vec2::new(rng.uniform(-1.0, 1.0) as f32, rng.uniform(0.01, 0.99) as f32);
        let (frame, unit) = (sphere.tangent_frame(uv), sphere.orthonormal_frame(uv));
        let flat = bump(&frame, Vec2::ZERO).coords.as_dvec3();
        assert!(angle(flat, unit.axes().z_axis.as_dvec3()) < 4.0 * EPS);
        // On unit axes at right angles, the frame's bump is that of the slope.
        let slope = vec2(&mut rng, 2.0);
        let direct = unit.vector_to_parent(normal_of_slope(slope)).coords.as_dvec3();
        assert!(angle(bump(&unit, slope).coords.as_dvec3(), direct) < 8.0 * EPS);
    }
    let none = Frame::<Tangent, Object>::new(
        Point3::new(Vec3::ZERO),
        Vector3::new(Vec3::X),
        Vector3::new(Vec3::X),
        Vector3::new(Vec3::ZERO),
    );
    assert_eq!(bump(&none, Vec2::ONE).coords, Vec3::Z);
    assert_eq!(bump(&Frame::IDENTITY, Vec2::NAN).coords, Vec3::Z);
}

/// A height of 16 bits at an index of the continued image.
fn texel(texture: Texture<'_, L16>, wrap: (impl Wrap, impl Wrap), i: i64, j: i64) -> f64 {
    let [i, j] = [i, j].map(|i| i32::try_from(i).unwrap());
    let (column, row) = (wrap.0.index(i, texture.width()), wrap.1.index(j, texture.height()));
    let from_top = texture.height() - 1 - row;
    f64::from(texture.texels()[(from_top * texture.width() + column) as usize]) / 65535.0
}

/// The bilinear surface about a point in texels, and the fractions.
struct Surface {
    height: f64,
    slope: [f64; 2],
    steepest: [f64; 2],
    twist: f64,
    fractions: [f64; 2],
}

fn surface(texture: Texture<'_, L16>, wrap: (impl Wrap, impl Wrap), [x, y]: [f64; 2]) -> Surface {
    let (i, j) = (x.floor() as i64, y.floor() as i64);
    let (s, t) = (x - x.floor(), y - y.floor());
    let at = |di, dj| texel(texture, wrap, i + di, j + dj);
    let [a, b, c, d] = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
    Surface {
        height: (1.0 - s) * (1.0 - t) * a + s * (1.0 - t) * b + (1.0 - s) * t * c + s * t * d,
        slope: [(1.0 - t) * (b - a) + t * (d - c), (1.0 - s) * (c - a) + s * (d - b)],
        steepest: [(b - a).abs().max((d - c).abs()), (c - a).abs().max((d - b).abs())],
        twist: (d - c - b + a).abs(),
        fractions: [s, t],
    }
}

/// Random heights of 16 bits, of 8 where `bytes`.
fn heights(rng: &mut Rng, width: u32, height: u32, bytes: bool) -> Vec<u16> {
    let mut height_of = || if bytes { u16::from(rng.u64() as u8) * 257 } else { rng.u64() as u16 };
    (0..width * height).map(|_| height_of()).collect()
}

/// Errors of the height and of the gradient, as shares of their bounds.
fn check_bilinear(rng: &mut Rng, wrap: (impl Wrap, impl Wrap)) -> [f64; 2] {
    let (width, height) = (rng.log_integer(300) as u32, rng.log_integer(40) as u32);
    let texels = heights(rng, width, height, false);
    let texture = Texture::new(L16, &texels, width, height).expect("as many");
    let far = if rng.one_in(3) { rng.log_uniform(1.0, 1_048_576.0) } else { 1.0 };
    let uv = vec2(rng, 2.5) * far;
    let (found, gradient) = bilinear_height(&texture, wrap, uv);
    if let Some(texture) = texture.power_of_two() {
        assert_eq!(bilinear_height(&texture, wrap, uv), (found, gradient));
    }
    let size = [f64::from(width), f64::from(height)];
    let exact = surface(texture, wrap, [0, 1].map(|k| f64::from(uv[k]) * size[k] - 0.5));
    // What coordinates may be moved by, in texels.
    let moved = size.map(|size| 5.0 * EPS * size);
    let at_border = (0..2).any(|k| (exact.fractions[k] - 0.5).abs() > 0.5 - moved[k]);
    if at_border {
        // The slope is another one beyond, the height nearly the same.
        assert!((f64::from(found) - exact.height).abs() <= 6.0 * EPS + moved[0] + moved[1]);
        return [0.0; 2];
    }
    let bound = 6.0 * EPS + moved[0] * exact.steepest[0] + moved[1] * exact.steepest[1];
    let share = (f64::from(found) - exact.height).abs() / bound;
    let shares = [0, 1].map(|k| {
        let error = (f64::from(gradient[k]) / size[k] - exact.slope[k]).abs();
        error / (6.0 * EPS + moved[1 - k] * exact.twist)
    });
    // The filter's weights have 8 bits.
    let filtered = texture.sampler_per_axis(Bilinear, wrap.0, wrap.1).scalar_lanes(One, uv.x, uv.y);
    let steep = (exact.steepest[0] + exact.steepest[1]) / 512.0;
    assert!((f64::from(filtered) - exact.height).abs() <= steep + 0.51 / 65535.0 + moved[0] + moved[1]);
    [share, shares[0].max(shares[1])]
}

#[test]
fn bilinear_heights_and_gradients() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..60_000 {
        for [height, gradient] in [
            check_bilinear(&mut rng, (Repeat, Clamp)),
            check_bilinear(&mut rng, (Clamp, Mirror)),
            check_bilinear(&mut rng, (Mirror, Repeat)),
        ] {
            worst = [worst[0].max(height), worst[1].max(gradient)];
        }
    }
    println!("shares of the bounds: heights {:.3}, gradients {:.3}", worst[0], worst[1]);
    assert!(worst.iter().all(|&share| share <= 1.0 && share > 0.3));
    let texture = Texture::new(L8, &[0, 255], 2, 1).expect("as many");
    assert_eq!(bilinear_height(&texture, (Repeat, Repeat), Vec2::new(0.5, 0.0)), (0.5, Vec2::new(2.0, 0.0)));
    for bad in [f32::NAN, f32::INFINITY, f32::MIN, 1e30] {
        let (height, gradient) = bilinear_height(&texture, (Repeat, Clamp), Vec2::splat(bad));
        assert!((0.0..=1.0).contains(&height) && gradient.abs().max_element() <= 2.0, "{bad}");
    }
}

/// In fixed point too, with bounds of its own, for coordinates and sides that it holds.
#[test]
fn fixed_bilinear_heights() {
    const STEP: f64 = 1.0 / 65536.0;
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..100_000 {
        let (width, height) = (rng.log_integer(1000) as u32, rng.range(1, 5) as u32);
        let texels = heights(&mut rng, width, height, false);
        let texture = Texture::new(L16, &texels, width, height).expect("as many");
        let uv = [0, 1].map(|_| Q16::from_bits(rng.range(0, 1 << 19) as i32 - (1 << 18)));
        let (found, gradient) = bilinear_height_lanes(OneFixed, &texture, (Repeat, Mirror), uv);
        let size = [f64::from(width), f64::from(height)];
        let real = |x: Q16| f64::from(x.to_bits()) * STEP;
        let exact = surface(texture, (Repeat, Mirror), [0, 1].map(|k| real(uv[k]) * size[k] - 0.5));
        // Products of coordinates and sides are exact, so that there is no border to cross.
        worst[0] = worst[0].max((real(found) - exact.height).abs() / STEP);
        for k in 0..2 {
            worst[1] = worst[1].max((real(gradient[k]) / size[k] - exact.slope[k]).abs() / STEP);
        }
    }
    println!("heights {:.3}, gradients {:.3} steps", worst[0], worst[1]);
    assert!(worst[0] <= 2.0 && worst[1] <= 2.0 && worst[0] > 0.8);
}

/// One height in three formats, and the numbers that samplers make of it.
#[test]
fn formats_of_heights() {
    let mut rng = Rng::new(run_seed());
    for _ in 0..2000 {
        let (width, height) = (rng.range(1, 9) as u32, rng.range(1, 9) as u32);
        let wide = heights(&mut rng, width, height, true);
        let bytes: Vec<u8> = wide.iter().map(|&height| (height / 257) as u8).collect();
        let palette: Vec<Rgba8> = (0..=255).map(|byte| Rgba8::new(byte, !byte, 7, 3)).collect();
        let eight = Texture::new(L8, &bytes, width, height).expect("as many");
        let sixteen = Texture::new(L16, &wide, width, height).expect("as many");
        let indexed = Texture::new(Indexed8 { palette: &palette }, &bytes, width, height).expect("as many");
        let uv = vec2(&mut rng, 2.5);
        let height = bilinear_height(&eight, (Repeat, Mirror), uv);
        assert_eq!(bilinear_height(&sixteen, (Repeat, Mirror), uv), height);
        assert_eq!(bilinear_height(&indexed, (Repeat, Mirror), uv), height);
        let height = eight.sampler(Bilinear, Mirror).height(uv);
        assert_eq!(sixteen.sampler(Bilinear, Mirror).height(uv), height);
        assert_eq!(indexed.sampler(Bilinear, Mirror).height(uv), height);
        let red = eight.sampler(Nearest, Mirror).sample(uv).to_bytes()[0];
        assert_eq!(sixteen.sampler(Nearest, Mirror).height(uv), f32::from(red) / 255.0);
        assert_eq!(indexed.sampler(Nearest, Mirror).height(uv), f32::from(red) / 255.0);
    }
    // All bits of a texel, and a border's red.
    for texel in 0..=u16::MAX {
        let texels = [texel];
        let texture = Texture::new(L16, &texels, 1, 1).expect("as many");
        let found = texture.sampler(Nearest, Border(Rgba8::from_bits(0xff00_3300)));
        assert_eq!(found.height(Vec2::splat(0.5)), f32::from(texel) / 65535.0);
        assert_eq!(found.height(Vec2::splat(-0.5)), 0.0);
    }
    let texture = Texture::new(L8, &[255], 1, 1).expect("as many");
    assert_eq!(texture.sampler(Bilinear, Border(Rgba8::from_bits(0x33))).height(Vec2::splat(-0.5)), 0.2);
    assert_eq!(
        bilinear_height(&texture, (Border(Rgba8::from_bits(0x33)), Border::default()), Vec2::splat(-0.5)).0,
        0.2
    );
}

/// A sampler is a height map, of its red channel.
#[test]
fn samplers_are_heights() {
    let texture = Texture::new(L8, &[0, 51, 102, 255], 4, 1).expect("as many");
    let relief = Relief { map: texture.sampler(Nearest, Repeat), low: -1.0, high: 4.0, extent: Vec2::ONE };
    let heights = [0.1, 0.3, 0.6, 0.9].map(|u| relief.height(Vec2::new(u, 0.0)));
    assert_eq!(heights, [-1.0, 0.0, 1.0, 4.0]);
}
