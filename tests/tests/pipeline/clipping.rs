//! Clipping: how exact new vertices are, that neighbours get the same ones, and that nothing is lost, gained or NaN.
#![allow(clippy::cast_possible_truncation, reason = "random f64 become the f32 that is tested")]

use alberti::{Cull, Frame, Mesh, NoDepth, Pass, Rgba8, Rgba8888, Sides, Subpixel, Target, View};
use alberti_math::glam::Vec3;
use alberti_math::{Eye, Point3};
use alberti_oracle::dd::Dd;
use alberti_oracle::rational::{self, Rational, clip_lerp, from_f32};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{
    EyeVertex, MAX_POLYGON, Perspective, Polygon, ProjectedVertex, SideBounds, clip_near_far, clip_sides,
};
use alberti_tests::errors::Errors;
use alberti_tests::random::{any_number, beside};
use std::iter;

/// The documented bounds, in ε of the larger of the two ends.
const LINEAR: f64 = 4.0;
const HYPERBOLIC: f64 = 7.0;

/// x, y, z and a varying, as numbers.
type Values = [f32; 4];

fn eye(v: Values) -> EyeVertex<f32> {
    EyeVertex { position: Point3::<Eye>::new(Vec3::new(v[0], v[1], v[2])), varying: v[3] }
}

fn values(v: &EyeVertex<f32>) -> Values {
    let p = v.position.coords;
    [p.x, p.y, p.z, v.varying]
}

fn bits(v: &EyeVertex<f32>) -> [u32; 4] {
    values(v).map(f32::to_bits)
}

fn side_values(v: &ProjectedVertex<f32>) -> [f32; 5] {
    [v.x, v.y, v.zs, v.q, v.varying]
}

fn side_bits(v: &ProjectedVertex<f32>) -> [u32; 5] {
    side_values(v).map(f32::to_bits)
}

/// The number at which the distance, `di` at one end and `dj` at the other, is zero; to 100 bits.
fn lerp(v: [f32; 2], [di, dj]: [Dd; 2]) -> Dd {
    (dj * f64::from(v[0]) - di * f64::from(v[1])) / (dj - di)
}

fn distances(v: [f32; 2], plane: f32) -> [Dd; 2] {
    v.map(|v| Dd::from(f64::from(v)) - Dd::from(f64::from(plane)))
}

fn larger(v: [f32; 2]) -> f64 {
    f64::from(v[0].abs().max(v[1].abs()))
}

/// Edges between a vertex on the near or far plane's one side and a vertex on its other side, in two triangles.
#[test]
fn near_and_far_vertices_are_exact_and_shared() {
    let mut rng = Rng::stream(run_seed(), 1);
    let mut errors = Errors::default();
    for i in 0..1_000_000 {
        let plane = rng.log_uniform(1e-3, 1e3);
        let (range, inward) = if rng.one_in(2) { ([plane, 1e30], 1.0) } else { ([-1e30, plane], -1.0) };
        let mut at = |side: f32| {
            let mut v = [(); 4].map(|()| any_number(&mut rng));
            v[2] = beside(&mut rng, plane, side);
            v
        };
        let (inside, outside, others) = (at(inward), at(-inward), [at(inward), at(inward)]);
        let clip = |t: [Values; 3]| clip_near_far(t.map(eye), range[0], range[1]);
        let one = clip([inside, outside, others[0]]);
        let two = clip([outside, inside, others[1]]);
        assert_eq!((one.vertices().len(), two.vertices().len()), (4, 4));
        let cut = one.vertices()[1];
        assert_eq!(bits(&cut), bits(&two.vertices()[1]), "neighbours differ: {inside:?} {outside:?}");
        assert_eq!(cut.position.coords.z.to_bits(), plane.to_bits());

        let d = distances([inside[2], outside[2]], plane);
        for k in [0, 1, 3] {
            let ends = [inside[k], outside[k]];
            let (got, exact) = (values(&cut)[k], lerp(ends, d));
            assert!(between(got, ends), "{got} outside {ends:?}");
            let error = exact.error_in_eps(got, larger(ends));
            errors.add(error);
            if i < 20_000 {
                let [di, dj] = [inside[2], outside[2]].map(|z| from_f32(z) - from_f32(plane));
                let full = clip_lerp(&from_f32(ends[0]), &from_f32(ends[1]), &di, &dj);
                let check = rational::error_in_eps(got, &full, larger(ends));
                assert!((check - error).abs() < 1e-9, "{check} {error}");
            }
        }
    }
    println!("near and far: {errors}");
    assert!(errors.max() <= LINEAR, "{errors}");
}

fn between(x: f32, [a, b]: [f32; 2]) -> bool {
    a.min(b) <= x && x <= a.max(b)
}

/// Edges that cross one side, in two triangles.
#[test]
fn side_vertices_are_exact_and_shared() {
    let mut rng = Rng::stream(run_seed(), 2);
    let (mut linear, mut hyperbolic) = (Errors::default(), Errors::default());
    for i in 0..1_000_000 {
        let bound = rng.log_uniform(0.5, 1e5);
        let (axis, sign) = (rng.index(2), if rng.one_in(2) { 1.0 } else { -1.0 });
        let near = rng.log_uniform(1e-3, 1e3);
        let mut at = |outward: f32| {
            let mut p = [(); 2].map(|()| rng.uniform(-1.0, 1.0) as f32 * bound);
            if outward > 0.0 {
                p[axis] = sign * beside(&mut rng, bound, 1.0);
            }
            let q = 1.0 / (near * rng.log_uniform(1.0, 1e12));
            ProjectedVertex { x: p[0], y: p[1], zs: rng.unit() as f32, q, varying: any_number(&mut rng) }
        };
        let (inside, outside, others) = (at(-1.0), at(1.0), [at(-1.0), at(-1.0)]);
        let bounds = SideBounds { x: bound, y: bound };
        let one = clip_sides(Polygon::triangle([inside, outside, others[0]]), bounds);
        let two = clip_sides(Polygon::triangle([outside, inside, others[1]]), bounds);
        assert_eq!((one.vertices().len(), two.vertices().len()), (4, 4));
        let new = |v: &&ProjectedVertex<f32>| {
            side_values(v)[axis] == sign * bound && ![inside, others[0], others[1]].contains(v)
        };
        let cut = *after(one.vertices(), inside).filter(new).expect("a vertex on the plane");
        let same = two.vertices().iter().any(|v| side_bits(v) == side_bits(&cut));
        assert!(same, "neighbours differ: {inside:?} {outside:?}");

        let ends = [side_values(&inside), side_values(&outside)];
        let d = distances(ends.map(|v| v[axis]), sign * bound);
        for k in (0..4).filter(|&k| k != axis) {
            let ends = ends.map(|v| v[k]);
            assert!(between(side_values(&cut)[k], ends));
            linear.add(lerp(ends, d).error_in_eps(side_values(&cut)[k], larger(ends)));
        }
        // In space, the weights on the screen count by q: dj qi of one end, -di qj of the other.
        let u = ends.map(|v| v[4]);
        let t = [d[1] * f64::from(inside.q), -d[0] * f64::from(outside.q)];
        let exact = (t[0] * f64::from(u[0]) + t[1] * f64::from(u[1])) / (t[0] + t[1]);
        let error = exact.error_in_eps(cut.varying, larger(u));
        assert!(between(cut.varying, u));
        hyperbolic.add(error);
        if i < 20_000 {
            let full = hyperbolic_cut(ends, axis, sign * bound);
            let check = rational::error_in_eps(cut.varying, &full, larger(u));
            assert!((check - error).abs() < 1e-9, "{check} {error}");
        }
    }
    println!("sides: {linear}\n  varyings {hyperbolic}");
    assert!(linear.max() <= LINEAR, "{linear}");
    assert!(hyperbolic.max() <= HYPERBOLIC, "{hyperbolic}");
}

/// The vertex that follows `vertex` on the polygon.
fn after(polygon: &[ProjectedVertex<f32>], vertex: ProjectedVertex<f32>) -> Option<&ProjectedVertex<f32>> {
    let place = polygon.iter().position(|v| *v == vertex)?;
    polygon.get((place + 1) % polygon.len())
}

/// u/z and 1/z are linear on the screen: clip them, and divide.
fn hyperbolic_cut([i, j]: [[f32; 5]; 2], axis: usize, plane: f32) -> Rational {
    let [di, dj] = [i, j].map(|v| from_f32(v[axis]) - from_f32(plane));
    let [qi, qj] = [i, j].map(|v| from_f32(v[3]));
    let over_z = clip_lerp(&(from_f32(i[4]) * &qi), &(from_f32(j[4]) * &qj), &di, &dj);
    over_z / clip_lerp(&qi, &qj, &di, &dj)
}

/// A triangle with coordinates of any size, the largest that the pipeline lets through among them.
fn any_triangle(rng: &mut Rng) -> [EyeVertex<f32>; 3] {
    let top = f32::MAX / 16.0;
    let kind = rng.index(4);
    let mut number = || {
        let size = match kind {
            0 => rng.log_uniform(f32::MIN_POSITIVE, top),
            1 => top * rng.unit() as f32,
            _ => rng.log_uniform(1e-3, 1e3),
        };
        let size = if rng.one_in(20) { [0.0, top, f32::from_bits(1), 1.0][rng.index(4)] } else { size };
        if rng.one_in(2) { -size } else { size }
    };
    [(); 3].map(|()| eye([number(), number(), number(), number()]))
}

#[test]
fn no_coordinate_overflows_and_clipping_twice_is_clipping_once() {
    let mut rng = Rng::stream(run_seed(), 3);
    let (mut cut, mut whole, mut most) = (0u32, 0u32, 0);
    for _ in 0..1_000_000 {
        let triangle = any_triangle(&mut rng);
        let near = if rng.one_in(4) { rng.log_uniform(1e-30, 1e30) } else { rng.log_uniform(1e-2, 1e2) };
        let far = near * rng.log_uniform(1.5, 1e6);
        let clipped = clip_near_far(triangle, near, far);
        let polygon = clipped.vertices();
        most = most.max(polygon.len());
        let inside = |v: &EyeVertex<f32>| {
            values(v).iter().all(|c| c.is_finite()) && (near..=far).contains(&v.position.coords.z)
        };
        assert!(polygon.iter().all(inside), "{triangle:?} between {near:e} and {far:e}: {polygon:?}");
        if triangle.iter().all(inside) {
            whole += 1;
            assert_eq!(polygon.len(), 3);
            assert!((0..3).all(|i| bits(&polygon[i]) == bits(&triangle[i])), "{triangle:?}");
        } else if !polygon.is_empty() {
            cut += 1;
        }
        for fan in clipped.fan() {
            let again = clip_near_far(fan, near, far);
            assert!(again.vertices().iter().map(bits).eq(fan.iter().map(bits)), "{fan:?}");
        }
    }
    println!("{cut} cut, {whole} whole, at most {most} vertices");
    assert!(cut > 100_000 && whole > 2_000 && most == 5);
}

#[test]
fn polygons_over_three_planes_and_more_stay_convex_bounded_and_small() {
    let mut rng = Rng::stream(run_seed(), 4);
    let (mut by_planes, mut most, mut area) = ([0u32; 7], 0, Errors::default());
    while by_planes[3..].iter().sum::<u32>() < 150_000 {
        let near = rng.log_uniform(0.1, 1.0);
        let view = Perspective::new(1.0, 1.0, near, near * rng.log_uniform(1.5, 30.0)).expect("a pyramid");
        let triangle = [(); 3].map(|()| {
            let z = rng.uniform(-1.0, 4.0) as f32;
            eye([rng.uniform(-4.0, 4.0) as f32, rng.uniform(-4.0, 4.0) as f32, z, any_number(&mut rng)])
        });
        let between = clip_near_far(triangle, view.near(), view.far());
        let depth = view.depth_map(rng.one_in(2));
        let projected = between.map(|v| view.project(&depth, &v));
        if projected.vertices().is_empty() {
            continue;
        }
        let bounds = SideBounds { x: rng.log_uniform(0.3, 3.0), y: rng.log_uniform(0.3, 3.0) };
        let clipped = clip_sides(projected, bounds);
        let polygon = clipped.vertices();
        let z = triangle.map(|v| v.position.coords.z);
        let beyond = |f: &dyn Fn(&ProjectedVertex<f32>) -> bool| projected.vertices().iter().any(f);
        let planes = [
            z.iter().any(|&z| z < view.near()),
            z.iter().any(|&z| z > view.far()),
            beyond(&|v| v.x < -bounds.x),
            beyond(&|v| v.x > bounds.x),
            beyond(&|v| v.y < -bounds.y),
            beyond(&|v| v.y > bounds.y),
        ];
        if !polygon.is_empty() {
            by_planes[planes.iter().filter(|&&crossed| crossed).count()] += 1;
        }
        most = most.max(polygon.len());
        for v in polygon {
            assert!(side_values(v).iter().all(|c| c.is_finite()), "{triangle:?}: {v:?}");
            assert!(
                v.x.abs() <= bounds.x && v.y.abs() <= bounds.y && (0.0..=1.0).contains(&v.zs) && v.q > 0.0
            );
        }
        let again = clip_sides(clipped, bounds);
        assert!(again.vertices().iter().map(side_bits).eq(polygon.iter().map(side_bits)), "{triangle:?}");

        // What is left has the area of what should be left.
        let plain = |v: &[ProjectedVertex<f32>]| -> Vec<[f64; 2]> {
            v.iter().map(|v| [f64::from(v.x), f64::from(v.y)]).collect()
        };
        let expected = doubled_area(&within(plain(projected.vertices()), bounds));
        let size = projected.vertices().iter().map(|v| v.x.abs().max(v.y.abs())).fold(1.0, f32::max);
        let chord = f64::from(bounds.x).hypot(f64::from(bounds.y)) * 2.0;
        let error = (doubled_area(&plain(polygon)) - expected) / (f64::from(size) * chord) * 2f64.powi(24);
        area.add(error);
    }
    println!("planes crossed {by_planes:?}, at most {most} vertices; area, in sizes times chords, {area}");
    // Each of at most five edges may be displaced by some roundings at both of its ends.
    assert!(area.max() <= 5.0 * 2.0 * LINEAR, "{area}");
    assert!(most > 7 && most <= MAX_POLYGON);
}

/// The part of a convex polygon within the bounds, in f64.
fn within(mut polygon: Vec<[f64; 2]>, bounds: SideBounds) -> Vec<[f64; 2]> {
    for (axis, bound) in [(0, bounds.x), (1, bounds.y)] {
        for sign in [-1.0, 1.0] {
            let depth = |p: [f64; 2]| f64::from(bound) - sign * p[axis];
            let mut kept = Vec::new();
            for (i, &p) in polygon.iter().enumerate() {
                let next = polygon[(i + 1) % polygon.len()];
                let [d, e] = [depth(p), depth(next)];
                if d >= 0.0 {
                    kept.push(p);
                }
                if (d >= 0.0) != (e >= 0.0) {
                    let t = d / (d - e);
                    kept.push([0, 1].map(|k| p[k] + t * (next[k] - p[k])));
                }
            }
            polygon = kept;
        }
    }
    polygon
}

fn doubled_area(polygon: &[[f64; 2]]) -> f64 {
    (0..polygon.len())
        .map(|i| {
            let [p, q] = [polygon[i], polygon[(i + 1) % polygon.len()]];
            p[0] * q[1] - p[1] * q[0]
        })
        .sum()
}

/// The parts between neighbouring planes have the area of the whole, up to what four roundings of x can move.
#[test]
fn slabs_add_up_to_the_triangle() {
    let mut rng = Rng::stream(run_seed(), 5);
    let (mut errors, mut parts) = (Errors::default(), 0);
    for _ in 0..100_000 {
        let triangle = [(); 3].map(|()| eye([any_number(&mut rng), 0.0, rng.uniform(1.0, 8.0) as f32, 0.0]));
        let planes = [1.0, rng.uniform(1.0, 4.0) as f32, 4.0, rng.uniform(4.0, 8.0) as f32, 8.0];
        let seen_from_above = |polygon: &[EyeVertex<f32>]| {
            let flat: Vec<_> =
                polygon.iter().map(|v| [v.position.coords.x, v.position.coords.z].map(f64::from)).collect();
            doubled_area(&flat)
        };
        let slabs: Vec<_> = planes.windows(2).map(|p| clip_near_far(triangle, p[0], p[1])).collect();
        parts += slabs.iter().filter(|slab| slab.vertices().len() > 2).count();
        let sum: f64 = slabs.iter().map(|slab| seen_from_above(slab.vertices())).sum();
        let size = triangle.iter().map(|v| v.position.coords.x.abs()).fold(0.0, f32::max);
        errors.add((sum - seen_from_above(&triangle)) / (f64::from(size) * 7.0) * 2f64.powi(24));
    }
    println!("{parts} parts; doubled area, in largest |x| times depth, {errors}");
    assert!(errors.max() <= 4.0 * LINEAR && parts > 200_000, "{errors}");
}

/// A clipped triangle writes each pixel once and is seen from one side. So it is where snapping puts a new vertex
/// beyond the line between its neighbours. The first one drew three pixels twice.
#[test]
fn clipped_triangles_are_not_turned_over() {
    let mut rng = Rng::stream(run_seed(), 10);
    let first = [
        Vec3::new(3.65913, 0.2603355, 8.179103),
        Vec3::new(-4.216201, 0.8391289, 6.342579),
        Vec3::new(-2.263942, -0.51022154, -9.959759),
    ];
    let any = || {
        [(); 3].map(|()| {
            let [x, y, z] = [5.0, 1.0, 10.0].map(|most| rng.uniform(-most, most) as f32);
            Vec3::new(x, y, z)
        })
    };
    let perspective = Perspective::new(1.0, 320.0 / 240.0, 0.1, 100.0).expect("possible");
    let view = View::new(Frame::IDENTITY, perspective);
    let (mut color, mut depth) = (vec![0; 320 * 240], vec![(); 320 * 240]);
    let mut clipped = 0;
    for triangle in iter::once(first).chain(iter::repeat_with(any).take(3000)) {
        let mesh = Mesh::new(&triangle, &[[0u16, 1, 2]], |&p| (p, ()));
        for subpixel in [Subpixel::Sub4, Subpixel::Sub8] {
            let mut draw = |cull| {
                color.fill(0);
                let target = Target::new(Rgba8888, NoDepth, 320, 240, &mut color, &mut depth);
                let pass = Pass::new(&view, &mesh, |()| Some(Rgba8::WHITE)).subpixel(subpixel);
                let stats = pass.cull(cull).sides(Sides::Cube).draw_counted(&mut target.expect("a frame"));
                (stats, color.iter().filter(|&&pixel| pixel != 0).count() as u64)
            };
            let (stats, drawn) = draw(Cull::None);
            clipped += stats.clipped;
            assert_eq!(stats.fragments, drawn, "{triangle:?} by {subpixel:?}");
            let sides = [Cull::Front, Cull::Back].map(|cull| draw(cull).1);
            assert!(sides.contains(&0) && sides.contains(&drawn), "{triangle:?} by {subpixel:?}");
        }
    }
    assert!(clipped > 3000, "{clipped}");
}
