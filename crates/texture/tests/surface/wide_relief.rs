//! Heights, slopes and parallax of several samples: every number of lanes gives the bits of one, and fixed point keeps
//! its own bounds.

use crate::lanes::{real, same};
use crate::support::vec3;
use alberti_math::lanes::{Lanes, Machine, One, OneFixed};
use alberti_math::{Q16, for_lanes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::format::{Indexed4, L8, L16, Rgba8};
use alberti_texture::surface::{
    HeightMap, LimitedParallax, OffsetParallax, ParallaxOcclusion, ParallaxSearch, Relief, SteepParallax,
    bilinear_height_lanes, bump_lanes, normal_of_slope_lanes,
};
use alberti_texture::{Bilinear, Border, Clamp, Mirror, Nearest, Repeat, Texture};
use glam::{DVec2, DVec3, Vec2};

const STEP: f64 = 1.0 / 65536.0;

fn check<H: HeightMap, L: Lanes>(lanes: L, relief: &Relief<H>, v: [L::Number; 14]) -> [L::Number; 18] {
    let uv = [v[0], v[1]];
    let view = [v[2], v[3], v[4]];
    let axes = [[v[5], v[6], v[7]], [v[8], v[9], v[10]], [v[11], v[12], v[13]]];
    let step = Vec2::new(0.125, 0.01);
    let slope = relief.slope_lanes(lanes, uv, step);
    let [nx, ny, nz] = relief.normal_lanes(lanes, uv, step);
    let [bx, by, bz] = bump_lanes(lanes, axes, slope);
    let [sx, sy, sz] = normal_of_slope_lanes(lanes, [v[2], v[3]]);
    let [a, b] = relief.parallax_lanes(OffsetParallax, lanes, uv, view);
    let [c, d] = relief.parallax_lanes(LimitedParallax, lanes, uv, view);
    let [e, f] = relief.parallax_lanes(SteepParallax { layers: 9 }, lanes, uv, view);
    let [g, h] = relief.parallax_lanes(ParallaxOcclusion { layers: 12 }, lanes, uv, view);
    [relief.height_lanes(lanes, uv), nx, ny, nz, bx, by, bz, sx, sy, sz, a, b, c, d, e, f, g, h]
}

fn same_reliefs(relief: &Relief<impl HeightMap>, given: &[[f32; 14]; 8]) {
    for machine in Machine::all() {
        for_lanes!(machine, lanes => {
            same(lanes, given, |v| check(lanes, relief, v), |v| check(One, relief, v));
        });
    }
}

fn same_bilinear(texture: &Texture<'_, L16>, given: &[[f32; 14]; 8]) {
    for machine in Machine::all() {
        for_lanes!(machine, lanes => {
            same(
                lanes,
                given,
                |v| {
                    let uv = [v[0], v[1]];
                    let (h, [x, y]) = bilinear_height_lanes(lanes, texture, (Repeat, Clamp), uv);
                    let power = texture.power_of_two().expect("it is");
                    let (p, [i, j]) = bilinear_height_lanes(lanes, &power, (Mirror, Border::default()), uv);
                    [h, x, y, p, i, j]
                },
                |v| {
                    let uv = [v[0], v[1]];
                    let (h, [x, y]) = bilinear_height_lanes(One, texture, (Repeat, Clamp), uv);
                    let (p, [i, j]) = bilinear_height_lanes(One, texture, (Mirror, Border::default()), uv);
                    assert!([h, x, y, p, i, j].iter().all(|x| x.is_finite()), "{v:?}");
                    [h, x, y, p, i, j]
                },
            );
        });
    }
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    let mut rng = Rng::new(run_seed());
    let wide: Vec<u16> = (0..128).map(|_| rng.u64() as u16).collect();
    let bytes: Vec<u8> = wide.iter().map(|&height| height as u8).collect();
    let palette: Vec<Rgba8> = (0..=15).map(|byte| Rgba8::new(byte * 17, 0, 0, 0)).collect();
    let wide = Texture::new(L16, &wide, 16, 8).expect("as many");
    let eight = Texture::new(L8, &bytes[..35], 7, 5).expect("as many");
    let indexed = Texture::new(Indexed4 { palette: &palette }, &bytes[..15], 5, 5).expect("as many");
    for _ in 0..1500 {
        let any = rng.one_in(4);
        let given: [[f32; 14]; 8] = std::array::from_fn(|_| {
            let any = any && rng.one_in(2);
            std::array::from_fn(|k| match (any, k) {
                (true, _) => rng.any_f32(),
                (false, 4) => rng.uniform(0.1, 1.0) as f32,
                (false, 0 | 1) => rng.uniform(-3.0, 3.0) as f32,
                (false, _) => rng.uniform(-1.0, 1.0) as f32,
            })
        });
        let (low, high) = (rng.uniform(-0.3, 0.1) as f32, rng.uniform(-0.1, 0.3) as f32);
        let extent = Vec2::new(rng.log_uniform(0.5, 2.0), 1.0);
        same_reliefs(&Relief { map: wide.sampler(Bilinear, Repeat), low, high, extent }, &given);
        same_reliefs(&Relief { map: eight.sampler(Bilinear, Clamp), low, high, extent }, &given);
        same_reliefs(&Relief { map: indexed.sampler(Nearest, Mirror), low, high, extent }, &given);
        let power = wide.power_of_two().expect("it is").sampler(Bilinear, Mirror);
        same_reliefs(&Relief { map: power, low, high, extent }, &given);
        let ramp = |uv: Vec2| 0.5 + 0.25 * uv.x - 0.125 * uv.y;
        same_reliefs(&Relief { map: ramp, low, high, extent }, &given);
        same_bilinear(&wide, &given);
    }
}

fn fixed(x: f64) -> Q16 {
    Q16::from_bits((x / STEP).round() as i32)
}

fn off(found: [Q16; 3], exact: DVec3) -> f64 {
    (DVec3::from(found.map(real)) - exact).abs().max_element() / STEP
}

#[test]
fn fixed_slopes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 4];
    for _ in 0..200_000 {
        let mut slope = || fixed(rng.uniform(-1.0, 1.0) * f64::from(rng.log_uniform(1e-3, 32000.0)));
        let slope = [slope(), slope()];
        let [a, b] = slope.map(real);
        let exact = DVec3::new(-a, -b, 1.0).normalize();
        worst[0] = worst[0].max(off(normal_of_slope_lanes(OneFixed, slope), exact));
        let z = vec3(&mut rng, 1.0).as_dvec3().normalize_or(DVec3::Z);
        let x = vec3(&mut rng, 1.0).as_dvec3().reject_from_normalized(z).normalize_or(DVec3::X);
        let axes = [x, z.cross(x), z].map(|axis| axis.to_array().map(fixed));
        let [x, y, z] = axes.map(|axis| DVec3::from(axis.map(real)));
        worst[1] = worst[1].max(off(bump_lanes(OneFixed, axes, slope), (z - x * a - y * b).normalize()));

        // A ramp, whose differences are exact but for the map's own steps.
        let (low, high) = (rng.uniform(-2.0, 0.0), rng.uniform(0.1, 2.0));
        let ramp = |uv: Vec2| 0.5 + 0.25341 * uv.x - 0.1251 * uv.y;
        let relief = Relief { map: ramp, low: low as f32, high: high as f32, extent: Vec2::new(0.5, 2.0) };
        let uv = [fixed(rng.uniform(-1.0, 1.0)), fixed(rng.uniform(-1.0, 1.0))];
        let h = 0.5 + 0.25341 * real(uv[0]) - 0.1251 * real(uv[1]);
        let found = real(relief.height_lanes(OneFixed, uv));
        let bound = 1.6 + low.abs() + high.abs();
        worst[2] = worst[2].max((found - low - (high - low) * h).abs() / STEP / bound);
        let found = relief.slope_lanes(OneFixed, uv, Vec2::splat(1.0 / 128.0)).map(real);
        for (found, exact, extent) in [(found[0], 0.25341, 0.5), (found[1], -0.1251, 2.0)] {
            let bound = (high - low) / extent * STEP * 128.0 + 4.0 * STEP;
            worst[3] = worst[3].max((found - exact * (high - low) / extent).abs() / bound);
        }
    }
    println!(
        "normals {:.3}, bumps {:.3} steps; shares of the bounds: {:.3?}",
        worst[0],
        worst[1],
        &worst[2..]
    );
    assert!(worst[0] <= 3.0 && worst[1] <= 6.0 && worst[2] <= 1.0 && worst[3] <= 1.0 && worst[3] > 0.3);
}

fn plain(policy: impl ParallaxSearch, rng: &mut Rng, layers: f64) -> f64 {
    let (low, high) = (rng.uniform(-1.0, 0.0) as f32, rng.uniform(0.1, 1.0) as f32);
    let h = rng.unit() as f32;
    let relief = Relief { map: |_: Vec2| h, low, high, extent: Vec2::new(1.0, 2.0) };
    let uv = [fixed(rng.uniform(-1.0, 1.0)), fixed(rng.uniform(-1.0, 1.0))];
    let grazing = f64::from(rng.log_uniform(0.05, 2.0));
    let view = [rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), grazing].map(fixed);
    let found = relief.parallax_lanes(policy, OneFixed, uv, view).map(real);
    let [x, y, z] = view.map(real);
    let slant = DVec2::new(x / z, y / z / 2.0);
    let (low, high) = (f64::from(low), f64::from(high));
    let exact = DVec2::from(uv.map(real)) + slant * (low + (high - low) * f64::from(h));
    let layer = (high - low) * layers * slant.length();
    let bound = layer + (4.0 * slant.length() + 4.0 * high.max(-low) + 4.0) * STEP;
    (DVec2::from(found) - exact).length() / bound
}

#[test]
fn fixed_parallax() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 4];
    for _ in 0..100_000 {
        let shares = [
            plain(OffsetParallax, &mut rng, 0.0),
            plain(ParallaxOcclusion { layers: 1 }, &mut rng, 0.0),
            plain(ParallaxOcclusion { layers: 16 }, &mut rng, 0.0),
            plain(SteepParallax { layers: 16 }, &mut rng, 1.0 / 16.0),
        ];
        worst = std::array::from_fn(|k| worst[k].max(shares[k]));
    }
    println!("shares of the bounds: {worst:.3?}");
    assert!(worst.iter().all(|&share| share <= 1.0 && share > 0.3));
}
