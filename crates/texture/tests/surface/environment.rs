//! Environment maps, against closed forms in `f64` and the table of the OpenGL specification.

use crate::lanes::{real, same};
use crate::support::{EPS, vec3};
use alberti_math::lanes::{Lanes, Machine, One, OneFixed};
use alberti_math::{Q16, for_lanes};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::environment::{CubeMap, Environment, LatLong, SphereMap, reflect_lanes};
use alberti_texture::format::L8;
use alberti_texture::{Bilinear, Clamp, Repeat, Texture};
use glam::{DVec2, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

const STEP: f64 = 1.0 / 65536.0;

/// Axes, diagonals of all signs, seams and poles, and what is near to them.
fn special() -> Vec<Vec3> {
    let numbers = [-1.0, -1e-3, -1e-30, -0.0, 0.0, 1e-30, 1e-3, 1.0];
    let mut all = Vec::new();
    for x in numbers {
        for y in numbers {
            for z in numbers {
                all.push(Vec3::new(x, y, z));
            }
        }
    }
    all
}

fn directions(rng: &mut Rng) -> Vec<Vec3> {
    let mut all = special();
    for _ in 0..200_000 {
        let v = vec3(rng, 1.0);
        // Often near to an axis, or to a plane through two.
        let v =
            v * Vec3::from([0, 1, 2].map(|_| if rng.one_in(4) { rng.log_uniform(1e-6, 1.0) } else { 1.0 }));
        all.push(v * if rng.one_in(8) { rng.log_uniform(1e-30, 1e35) } else { 1.0 });
    }
    all
}

/// A direction in fixed point, of length 1 or more.
fn fixed(v: Vec3, rng: &mut Rng) -> Option<[Q16; 3]> {
    let long = v.as_dvec3().normalize_or_zero() * f64::from(rng.log_uniform(1.01, 16000.0));
    (long != DVec3::ZERO).then(|| long.to_array().map(|x| Q16::from_bits((x / STEP).round() as i32)))
}

fn at(place: [f32; 2]) -> DVec2 {
    assert!(place.iter().all(|c| (0.0..=1.0).contains(c)), "{place:?}");
    DVec2::from(place.map(f64::from))
}

/// Difference on the image; u goes around where `around`.
fn apart(a: DVec2, b: DVec2, around: bool) -> DVec2 {
    let d = (a - b).abs();
    DVec2::new(if around { d.x.min(1.0 - d.x).abs() } else { d.x }, d.y)
}

fn lat_long(d: DVec3) -> DVec2 {
    let u = if d.x == 0.0 && d.z == 0.0 { 0.5 } else { 0.5 + d.x.atan2(-d.z) / TAU };
    DVec2::new(u, 0.5 + d.y.atan2(d.x.hypot(d.z)) / PI)
}

#[test]
fn longitudes_and_latitudes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [DVec2::ZERO; 2];
    for d in directions(&mut rng) {
        if d == Vec3::ZERO {
            continue;
        }
        let found = at(LatLong.place(One, d.to_array()));
        worst[0] = worst[0].max(apart(found, lat_long(d.as_dvec3()), true) / EPS);
        if let Some(d) = fixed(d, &mut rng) {
            let exact = DVec3::from(d.map(real));
            let mut off =
                apart(DVec2::from(LatLong.place(OneFixed, d).map(real)), lat_long(exact), true) / STEP;
            // Near the poles, directions are too short across.
            off.x *= exact.x.hypot(exact.z).min(1.0);
            worst[1] = worst[1].max(off);
        }
    }
    println!("u and v: {:.3?}ε, in fixed point {:.3?} steps", worst[0].to_array(), worst[1].to_array());
    assert!(worst[0].x <= 2.5 && worst[0].y <= 3.0 && worst[0].min_element() > 1.0);
    assert!(worst[1].x <= 4.0 && worst[1].y <= 6.0 && worst[1].min_element() > 1.0);

    let place = |x, y, z| LatLong.place(One, [x, y, z]);
    assert_eq!([place(0.0, 0.0, -2.0), place(0.0, 0.0, 3.0)], [[0.5, 0.5], [1.0, 0.5]]);
    assert_eq!([place(1.0, 0.0, 0.0), place(-9.0, 0.0, 0.0)], [[0.75, 0.5], [0.25, 0.5]]);
    assert_eq!([place(0.0, 1.0, 0.0), place(0.0, -1e-30, 0.0)], [[0.5, 1.0], [0.5, 0.0]]);
}

fn sphere_map(d: DVec3) -> DVec2 {
    // Of halves of angles, so that nothing cancels: 1 − z = 2 sin²(α/2), and m = 4 sin(α/2).
    let across = d.x.hypot(d.y);
    let half = across.atan2(d.z) / 2.0;
    let radius = half.cos() / 2.0;
    if across == 0.0 { DVec2::splat(0.5) } else { DVec2::new(d.x, d.y) / across * radius + 0.5 }
}

#[test]
fn mirror_balls() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for d in directions(&mut rng) {
        let forward = |d: DVec3| d.x.hypot(d.y).atan2(d.z);
        let alpha = forward(d.as_dvec3());
        let found = at(SphereMap.place(One, d.to_array()));
        if alpha > 1e-5 && (1e-15..1e15).contains(&d.length()) {
            let off = apart(found, sphere_map(d.as_dvec3()), false).max_element() / EPS;
            worst[0] = worst[0].max(off / (2.0 + 2.0 / alpha));
        }
        if let Some(d) = fixed(d, &mut rng) {
            let exact = DVec3::from(d.map(real));
            let found = DVec2::from(SphereMap.place(OneFixed, d).map(real));
            let alpha = forward(exact);
            if alpha > 4.0 * STEP {
                let off = apart(found, sphere_map(exact), false).max_element() / STEP;
                worst[1] = worst[1].max(off / (3.0 + 4.0 / alpha));
            }
            assert!(found.min_element() >= 0.0 && found.max_element() <= 1.0);
        }
    }
    println!("shares of the bounds, in fixed point also: {worst:.3?}");
    assert!(worst.iter().all(|&share| share <= 1.0 && share > 0.3));
    let place = |x, y, z| SphereMap.place(One, [x, y, z]);
    assert_eq!([place(0.0, 0.0, -2.0), place(0.0, 0.0, 3.0)], [[0.5; 2]; 2]);
    // The formula of the specification, whose z is the opposite.
    let r = DVec3::new(0.6, 0.0, -0.8);
    let m = 2.0 * (r.x * r.x + r.y * r.y + (-r.z + 1.0).powi(2)).sqrt();
    let expected = DVec2::new(r.x / m + 0.5, r.y / m + 0.5);
    assert!(apart(at(place(0.6, 0.0, -0.8)), expected, false).max_element() < 4.0 * EPS);
}

/// sc, tc and ma for +x, −x, +y, −y, +z, −z, by the table.
fn table(d: DVec3) -> [[f64; 3]; 6] {
    let DVec3 { x, y, z } = d;
    [[-z, -y, x], [z, -y, -x], [x, z, y], [x, -z, -y], [x, -y, z], [-x, -y, -z]]
}

/// Coordinates of the first face whose axis is the greatest.
fn cube(d: DVec3, margin: f64) -> DVec2 {
    let table = table(d);
    let greatest = d.abs().max_element();
    let face = table.iter().position(|&[_, _, ma]| ma == greatest && ma > 0.0).unwrap_or(0);
    let [s, t] = [0, 1].map(|k| {
        let along = if greatest > 0.0 { table[face][k] / greatest } else { 0.0 };
        f64::midpoint(along, 1.0).clamp(margin, 1.0 - margin)
    });
    DVec2::new(s, 1.0 - (face as f64 + t) / 6.0)
}

#[test]
fn cubes() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [DVec2::ZERO; 2];
    for d in directions(&mut rng) {
        let side = rng.log_integer(2730) as u32;
        let half = 0.5 / f64::from(side);
        let found = at(CubeMap { side }.place(One, d.to_array()));
        let margin = (half + 2f64.powi(-20)).min(0.5);
        worst[0] = worst[0].max(apart(found, cube(d.as_dvec3(), margin), false) / EPS);
        if let Some(d) = fixed(d, &mut rng) {
            let found = DVec2::from(CubeMap { side }.place(OneFixed, d).map(real));
            let exact = cube(DVec3::from(d.map(real)), (half + 2f64.powi(-12)).min(0.5));
            worst[1] = worst[1].max(apart(found, exact, false) / STEP);
        }
    }
    println!("u and v: {:.3?}ε, in fixed point {:.3?} steps", worst[0].to_array(), worst[1].to_array());
    assert!(worst[0].x <= 1.0 && worst[0].y <= 2.0 && worst[0].min_element() > 0.5);
    assert!(worst[1].x <= 1.6 && worst[1].y <= 2.0 && worst[1].min_element() > 0.8);
    // The middle and a corner of each face.
    for (face, axis) in
        [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].into_iter().enumerate()
    {
        let [u, v] = CubeMap { side: 8 }.place(One, axis.to_array());
        assert_eq!(u, 0.5);
        assert!((f64::from(v) * 6.0 - (5.5 - face as f64)).abs() < 1e-6);
    }
}

/// Six colours: a bilinear filter finds one of them, unmixed, wherever it is asked.
#[test]
fn faces_do_not_bleed() {
    let mut rng = Rng::new(run_seed());
    for side in [1, 2, 7, 64, 683, 2730] {
        let colors = [0, 51, 102, 153, 204, 255];
        let texels: Vec<u8> = colors.iter().flat_map(|&color| vec![color; (side * side) as usize]).collect();
        let texture = Texture::new(L8, &texels, side, 6 * side).expect("as many");
        let sampler = texture.sampler(Bilinear, Clamp);
        let repeated = texture.sampler(Bilinear, Repeat);
        let near_edges = (0..30_000).map(|_| {
            let mut v = vec3(&mut rng, 1.0);
            let (from, to) = (rng.range(0, 2) as usize, rng.range(0, 2) as usize);
            v[to] =
                v[from] * if rng.one_in(2) { 1.0 } else { -1.0 } * (1.0 + rng.uniform(-1e-6, 1e-6) as f32);
            v
        });
        for d in near_edges.chain(special()).collect::<Vec<_>>() {
            let cube = CubeMap { side };
            let place = cube.place(One, d.to_array());
            let face = table(d.as_dvec3())
                .iter()
                .position(|&[_, _, ma]| ma == d.as_dvec3().abs().max_element() && ma > 0.0)
                .unwrap_or(0);
            assert_eq!(sampler.sample(place.into()).to_bytes()[0], colors[face], "{d} {side}");
            assert_eq!(repeated.sample(place.into()).to_bytes()[0], colors[face], "{d} {side}");
            if let Some(d) = fixed(d, &mut rng) {
                let [u, v] = cube.place(OneFixed, d);
                let found = (sampler.sample_lanes(OneFixed, u, v).0 & 255) as u8;
                assert!(colors.contains(&found), "{d:?} {side}: {found}");
            }
        }
    }
}

#[test]
fn what_has_no_direction() {
    let not = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut all = vec![[0.0; 3], [-0.0; 3]];
    for bad in not {
        all.extend([[bad, 0.0, 0.0], [1.0, bad, -1.0], [0.0, 1.0, bad], [bad; 3], [bad, f32::INFINITY, 1.0]]);
    }
    for d in all {
        assert_eq!(LatLong.place(One, d), [0.5; 2], "{d:?}");
        assert_eq!(SphereMap.place(One, d), [0.5; 2], "{d:?}");
        assert_eq!(
            CubeMap { side: 4 }.place(One, d),
            CubeMap { side: 4 }.place(One, [1.0, 0.0, 0.0]),
            "{d:?}"
        );
    }
    let zero = [Q16::ZERO; 3];
    let half = [Q16::from_bits(1 << 15); 2];
    assert_eq!([LatLong.place(OneFixed, zero), SphereMap.place(OneFixed, zero)], [half; 2]);
    let x = [Q16::ONE, Q16::ZERO, Q16::ZERO];
    assert_eq!(CubeMap { side: 4 }.place(OneFixed, zero), CubeMap { side: 4 }.place(OneFixed, x));
    // Sides that no texture has.
    assert_eq!(CubeMap { side: 0 }.place(One, [1.0, 0.5, 0.2])[0], 0.5);
}

fn places<L: Lanes>(lanes: L, v: [L::Number; 6]) -> [L::Number; 9] {
    let (d, n) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
    let [a, b] = LatLong.place(lanes, d);
    let [c, e] = SphereMap.place(lanes, d);
    let [f, g] = CubeMap { side: 16 }.place(lanes, d);
    let [x, y, z] = reflect_lanes(lanes, n, d);
    [a, b, c, e, f, g, x, y, z]
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    let mut rng = Rng::new(run_seed());
    for i in 0..20_000 {
        let given: [[f32; 6]; 8] = std::array::from_fn(|_| {
            std::array::from_fn(|_| if i % 4 == 0 { rng.any_f32() } else { rng.uniform(-1.0, 1.0) as f32 })
        });
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                same(lanes, &given, |v| places(lanes, v), |v| {
                    let found = places(One, v);
                    assert!(found[..6].iter().all(|c| (0.0..=1.0).contains(c)), "{v:?} {found:?}");
                    found
                });
            });
        }
    }
}

#[test]
fn reflections() {
    let mut rng = Rng::new(run_seed());
    let mut worst = [0.0f64; 2];
    for _ in 0..200_000 {
        let [n, v] = [0, 1].map(|_| vec3(&mut rng, 1.0).normalize_or(Vec3::X));
        let exact = |n: DVec3, v: DVec3| n * (2.0 * n.dot(v)) - v;
        let found = Vec3::from(reflect_lanes(One, n.to_array(), v.to_array())).as_dvec3();
        worst[0] = worst[0].max((found - exact(n.as_dvec3(), v.as_dvec3())).abs().max_element() / EPS);
        let [n, v] = [n, v].map(|v| v.to_array().map(Q16::from_f32));
        let found = DVec3::from(reflect_lanes(OneFixed, n, v).map(real));
        let exact = exact(DVec3::from(n.map(real)), DVec3::from(v.map(real)));
        worst[1] = worst[1].max((found - exact).abs().max_element() / STEP);
    }
    println!("{:.3}ε, in fixed point {:.3} steps", worst[0], worst[1]);
    assert!(worst[0] <= 8.0 && worst[1] <= 4.0 && worst[0] > 2.0 && worst[1] > 1.0);
}
