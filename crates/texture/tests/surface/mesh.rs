//! Normals and tangents of meshes, against sums in `f64` and the frames of formulas.

use crate::support::{EPS, angle, not_orthonormal, vec2, vec3};
use alberti_math::{Point3, Vector3};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_texture::surface::{
    LengthError, Parametric, Sphere, Torus, frame_of_tangent, vertex_normals, vertex_tangents,
};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A fan of triangles about vertex 0.
struct Fan {
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

fn fan(rng: &mut Rng) -> Fan {
    let count = rng.range(3, 8) as u32;
    let (bend, mirror) = (vec3(rng, 0.3), if rng.one_in(2) { -1.0 } else { 1.0 });
    let size = rng.log_uniform(1e-3, 1e3);
    let mut fan = Fan { positions: vec![Vec3::ZERO], uvs: vec![vec2(rng, 2.0)], triangles: vec![] };
    let turn = rng.uniform(0.0, 6.0);
    for k in 0..count {
        let at = turn + std::f64::consts::TAU * (f64::from(k) + rng.uniform(0.0, 0.6)) / f64::from(count);
        let reach = rng.uniform(0.2, 1.0);
        let (x, y) = ((at.cos() * reach) as f32, (at.sin() * reach) as f32);
        fan.positions.push(Vec3::new(x, y, bend.x * x * x + bend.y * y * y) * size);
        fan.uvs.push(fan.uvs[0] + Vec2::new(mirror * (x + bend.z * y), y) * 0.5 + vec2(rng, 0.05));
        fan.triangles.push([0, k + 1, (k + 1) % count + 1]);
    }
    fan
}

/// The sum of doubled normals, that of tangents times areas, the area that is not mirrored less the rest, and all area.
fn exact(fan: &Fan) -> ([DVec3; 2], [f64; 2]) {
    let (mut sums, mut areas) = ([DVec3::ZERO; 2], [0.0; 2]);
    for triangle in &fan.triangles {
        let [a, b, c] = triangle.map(|i| fan.positions[i as usize].as_dvec3());
        let [ta, tb, tc]: [DVec2; 3] = triangle.map(|i| fan.uvs[i as usize].as_dvec2());
        let doubled = (b - a).cross(c - a);
        // Where u = 1 and v = 0 is, as the inverse of a matrix has it.
        let inverse = glam::DMat2::from_cols(tb - ta, tc - ta).inverse() * DVec2::X;
        let tangent = (b - a) * inverse.x + (c - a) * inverse.y;
        sums[0] += doubled;
        sums[1] += tangent.normalize() * doubled.length();
        areas[0] += doubled.length() * (tb - ta).perp_dot(tc - ta).signum();
        areas[1] += doubled.length();
    }
    (sums, areas)
}

#[test]
fn vertices_are_means_weighted_by_area() {
    let mut rng = Rng::new(run_seed());
    let (mut worst, mut handed) = ([0.0f64; 4], [0, 0]);
    for _ in 0..40_000 {
        let fan = fan(&mut rng);
        let (count, k) = (fan.positions.len(), fan.triangles.len() as f64);
        let (mut normals, mut tangents) = (vec![Vec3::NAN; count], vec![[f32::NAN; 4]; count]);
        vertex_normals(&fan.positions, &fan.triangles, &mut normals).expect("as many");
        let given: Vec<Vec3> = normals.iter().map(|n| (*n + vec3(&mut rng, 0.2)).normalize()).collect();
        vertex_tangents(&fan.positions, &given, &fan.uvs, &fan.triangles, &mut tangents).expect("as many");
        let ([normal, tangent], [signed, area]) = exact(&fan);
        let n = given[0].as_dvec3().normalize();
        let across = tangent - n * n.dot(tangent);
        if across.length() < area / 32.0 {
            continue;
        }
        worst[0] = worst[0].max(angle(normals[0].as_dvec3(), normal) * normal.length() / area / (k + 2.0));
        let [x, y, z, w] = tangents[0];
        let found = Vec3::new(x, y, z).as_dvec3();
        worst[1] = worst[1].max(angle(found, across) * across.length() / area / (k + 5.0));
        worst[2] =
            worst[2].max((found.length() - 1.0).abs()).max((normals[0].as_dvec3().length() - 1.0).abs());
        worst[3] = worst[3].max(found.dot(given[0].as_dvec3()).abs());
        if signed.abs() > area * 1e-6 {
            assert_eq!(f64::from(w), signed.signum());
            handed[usize::from(w < 0.0)] += 1;
        }
    }
    let [normal, tangent, length, cosine] = worst.map(|error| error / EPS);
    println!(
        "normals {normal:.2} (k + 2)ε, tangents {tangent:.2} (k + 5)ε, lengths {length:.3}ε, cosines {cosine:.3}ε, {handed:?}"
    );
    assert!(normal <= 1.0 && tangent <= 1.0 && length <= 1.1 && cosine <= 1.1);
    assert!(handed[0] > 10_000 && handed[1] > 10_000);
}

/// A grid over a surface, whose vertices have the surface's frame but for what the cells' size makes of it.
fn check_surface(surface: &impl Parametric, mirrored: bool, u: f32, v: [f32; 2]) -> f64 {
    let n = 64u32;
    let (mut positions, mut normals, mut uvs, mut triangles) = (vec![], vec![], vec![], vec![]);
    let mut exact = vec![];
    for j in 0..=n {
        for i in 0..=n {
            let t = [i, j].map(|k| k as f32 / n as f32);
            let uv = Vec2::new(t[0] * u, v[0] + t[1] * (v[1] - v[0]));
            let frame = surface.orthonormal_frame(uv);
            positions.push(frame.origin().coords);
            normals.push(frame.axes().z_axis);
            uvs.push(if mirrored { Vec2::new(-uv.x, uv.y) } else { uv });
            exact.push(frame.axes());
            if i < n && j < n {
                let at = j * (n + 1) + i;
                triangles.push([at, at + 1, at + n + 2]);
                triangles.push([at, at + n + 2, at + n + 1]);
            }
        }
    }
    let mut tangents = vec![[0.0; 4]; positions.len()];
    vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents).expect("as many");
    let mut found = vec![Vec3::ZERO; positions.len()];
    vertex_normals(&positions, &triangles, &mut found).expect("as many");
    let mut worst = 0.0f64;
    for k in 0..positions.len() {
        let frame = frame_of_tangent(Point3::new(positions[k]), Vector3::new(normals[k]), tangents[k]);
        let sign = if mirrored { -1.0 } else { 1.0 };
        for (found, exact) in [
            (frame.axes().x_axis * sign, exact[k].x_axis),
            (frame.axes().y_axis, exact[k].y_axis),
            (frame.axes().z_axis, exact[k].z_axis),
            (found[k], exact[k].z_axis),
        ] {
            worst = worst.max(angle(found.as_dvec3(), exact.as_dvec3()));
        }
        assert_eq!(tangents[k][3], sign);
    }
    worst
}

#[test]
fn meshes_of_surfaces_have_their_frames() {
    for mirrored in [false, true] {
        // Within the angle between neighbouring cells.
        let sphere = check_surface(&Sphere { radius: 3.0 }, mirrored, 0.5, [0.2, 0.8]);
        let torus = check_surface(&Torus { major: 3.0, minor: 1.0 }, mirrored, 1.0, [0.0, 1.0]);
        println!("sphere {sphere:.4}, torus {torus:.4}");
        assert!(sphere < 0.05 && torus < 0.1);
    }
}

/// Any mesh at all: indices out of range, equal coordinates, NaN.
#[test]
fn never_nan() {
    let mut rng = Rng::new(run_seed());
    for round in 0..20_000 {
        let count = rng.range(1, 6) as usize;
        let mut number = || match round % 3 {
            0 => rng.any_f32(),
            1 => rng.range(-2, 2) as f32,
            _ => rng.uniform(-1.0, 1.0) as f32,
        };
        let positions: Vec<Vec3> = (0..count).map(|_| Vec3::new(number(), number(), number())).collect();
        let normals: Vec<Vec3> = (0..count).map(|_| Vec3::new(number(), number(), number())).collect();
        let uvs: Vec<Vec2> = (0..count).map(|_| Vec2::new(number(), number()).round()).collect();
        let triangles: Vec<[u32; 3]> = (0..6).map(|_| [(); 3].map(|()| rng.range(0, 6) as u32)).collect();
        let mut tangents = vec![[f32::NAN; 4]; count];
        vertex_tangents(&positions, &normals, &uvs, &triangles, &mut tangents).expect("as many");
        let mut found = vec![Vec3::NAN; count];
        vertex_normals(&positions, &triangles, &mut found).expect("as many");
        for k in 0..count {
            let [x, y, z, w] = tangents[k];
            assert!((Vec3::new(x, y, z).as_dvec3().length() - 1.0).abs() <= 1.1 * EPS && w.abs() == 1.0);
            assert!((found[k].as_dvec3().length() - 1.0).abs() <= 1.1 * EPS);
            let frame = frame_of_tangent(Point3::new(Vec3::ZERO), Vector3::new(normals[k]), tangents[k]);
            let axes = [frame.axes().x_axis, frame.axes().y_axis, frame.axes().z_axis];
            let [length, cosine] = not_orthonormal(axes);
            assert!(length <= 1.1 && cosine <= 2.2);
            assert_eq!(axes[0].cross(axes[1]).dot(axes[2]) > 0.0, w > 0.0);
        }
    }
}

#[test]
fn what_is_missing_is_chosen_or_named() {
    let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let mut tangents = [[0.0; 4]; 3];
    let same = [Vec2::ONE; 3];
    let normals = [Vec3::Z, Vec3::X, Vec3::ZERO];
    vertex_tangents(&positions, &normals, &same, &[[0, 1, 2]], &mut tangents).expect("as many");
    assert_eq!(tangents, [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]]);
    let error = vertex_tangents(&positions, &normals[..2], &same, &[], &mut tangents).unwrap_err();
    assert_eq!(error, LengthError { found: 2, expected: 3 });
    assert_eq!(error.to_string(), "a buffer of 2 values, which must hold 3");
    let mut normals = [Vec3::ZERO; 3];
    vertex_normals(&positions, &[[0, 1, 2], [0, 1, 9]], &mut normals).expect("as many");
    assert_eq!(normals, [Vec3::Z; 3]);
    vertex_normals(&positions, &[], &mut normals).expect("as many");
    assert_eq!(normals, [Vec3::Z; 3]);
}
