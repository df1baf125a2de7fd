//! The clip against near and far, and against the sides.

use crate::{Row, SMALLEST, Sample, Table, brief};
use alberti_math::glam::Vec3;
use alberti_math::{Point3, blend2};
use alberti_oracle::rational::{Rational, clip_lerp, from_f32};
use alberti_oracle::rng::Rng;
use alberti_projection::{EyeVertex, Polygon, ProjectedVertex, SideBounds, clip_near_far, clip_sides};

/// The documented bounds.
const LINEAR: f64 = 4.0;
const HYPERBOLIC: f64 = 7.0;

pub(crate) fn tables() -> Vec<Table> {
    let mut rows = Vec::new();
    for (region, sizes) in [
        ("coordinates from 0.1 to 10", [0.1f32, 10.0]),
        ("up to 1e30", [1e-30, 1e30]),
        ("up to `f32::MAX`/16", [1e30, f32::MAX / 16.0]),
        ("subnormal", [f32::from_bits(1), f32::MIN_POSITIVE]),
    ] {
        rows.push(Row::new("clip_near_far", region, LINEAR, move |rng| near_far(rng, sizes)));
    }
    for ratio in [1.1f32, 1e3, 1e6, 1e12] {
        let region = move |what: &str| format!("{what}, ratio of q to {}", brief(ratio));
        rows.push(Row::new("clip_sides", region("xs, ys, zs, q"), LINEAR, move |rng| {
            sides(rng, ratio, [1e-6, 1e6], false)
        }));
        rows.push(Row::new("clip_sides", region("varying"), HYPERBOLIC, move |rng| {
            sides(rng, ratio, [1e-6, 1e6], true)
        }));
    }
    for (region, sizes) in [
        ("varying to 1e30, any ratio of q", [1e-30, 1e30]),
        ("varying subnormal, any ratio of q", [f32::from_bits(1), f32::MIN_POSITIVE]),
    ] {
        rows.push(Row::new("clip_sides", region, HYPERBOLIC, move |rng| sides(rng, 1e12, sizes, true)));
    }
    for (region, sizes) in [
        ("values from 0.1 to 10", [0.1f32, 10.0]),
        ("values up to 1e38", [1e-38, 1e38]),
        ("subnormal values", [f32::from_bits(1), f32::MIN_POSITIVE]),
    ] {
        rows.push(Row::new("blend2", region, 2.0, move |rng| blended(rng, sizes)));
    }
    vec![Table {
        title: "Clipping",
        about: "Errors of new vertices, and of `blend2`, are in ε of the larger of the two ends, or of the smallest \
                normal number.",
        rows,
    }]
}

fn signed(rng: &mut Rng, [least, most]: [f32; 2]) -> f32 {
    let size = rng.log_uniform(least, most);
    if rng.one_in(2) { -size } else { size }
}

/// Two values at weights that sum to 1 exactly.
fn blended(rng: &mut Rng, sizes: [f32; 2]) -> Sample {
    let [a, b] = [(); 2].map(|()| signed(rng, sizes));
    // A multiple of 2^-23 up to 1, so that 1 minus it is one too.
    let weight = rng.uniform(1.0, 2.0) as f32 - 1.0;
    let weights = if rng.one_in(2) { [weight, 1.0 - weight] } else { [1.0 - weight, weight] };
    let exact = from_f32(weights[0]) * from_f32(a) + from_f32(weights[1]) * from_f32(b);
    Sample::new(blend2(weights, [a, b]), &exact, scale(a, b))
}

fn scale(a: f32, b: f32) -> f64 {
    f64::from(a.abs().max(b.abs())).max(SMALLEST)
}

/// Beyond `bound`, by anything from an ulp or so to `sizes`.
fn beyond(rng: &mut Rng, bound: f32, most: f32) -> f32 {
    match rng.index(3) {
        0 => (bound * rng.uniform(1.0, 4.0) as f32).max(bound.next_up()),
        1 => (bound * (1.0 + rng.log_uniform(2e-7, 1.0))).max(bound.next_up()),
        _ => rng.log_uniform(bound.next_up(), most.max(bound * 4.0)),
    }
}

/// An edge across the near or the far plane: the worst of x, y and the varying.
fn near_far(rng: &mut Rng, sizes: [f32; 2]) -> Sample {
    let near = rng.log_uniform(1e-3, 1e3);
    let far = near * rng.log_uniform(1.1, 1e9);
    let any = |rng: &mut Rng, z: f32| {
        let position = Point3::new(Vec3::new(signed(rng, sizes), signed(rng, sizes), z));
        EyeVertex { position, varying: signed(rng, sizes) }
    };
    let inside = near + (far - near) * (rng.unit() as f32);
    let (plane, outside) = if rng.one_in(2) {
        (near, near - beyond(rng, f32::MIN_POSITIVE, near.max(sizes[1])))
    } else {
        (far, beyond(rng, far, sizes[1]))
    };
    let z = [inside.clamp(near, far), outside];
    if z[1] >= near && z[1] <= far || z[0] == plane {
        return near_far(rng, sizes);
    }
    let [i, j] = z.map(|z| any(rng, z));
    let polygon = clip_near_far([i, j, i], near, far);
    let cut = polygon.vertices()[1];
    assert_eq!(cut.position.coords.z, plane);
    let [di, dj] = z.map(|z| from_f32(z) - from_f32(plane));
    let parts = |v: &EyeVertex<f32>| [v.position.coords.x, v.position.coords.y, v.varying];
    let (got, a, b) = (parts(&cut), parts(&i), parts(&j));
    let [x, y, varying] = [0, 1, 2].map(|k| {
        let exact = clip_lerp(&from_f32(a[k]), &from_f32(b[k]), &di, &dj);
        Sample::new(got[k], &exact, scale(a[k], b[k]))
    });
    x.worst(y).worst(varying)
}

/// An edge across one of the four sides.
fn sides(rng: &mut Rng, ratio: f32, sizes: [f32; 2], varying: bool) -> Sample {
    let bound = rng.log_uniform(0.5, 1e5);
    let near = rng.log_uniform(1e-3, 1e3);
    let (axis, sign) = (rng.index(2), if rng.one_in(2) { 1.0 } else { -1.0 });
    let mut any = |outside: bool| {
        let mut p = [(); 2].map(|()| rng.uniform(-1.0, 1.0) as f32 * bound);
        if outside {
            p[axis] = sign * beyond(rng, bound, 1e30);
        }
        let q = 1.0 / (near * rng.log_uniform(1.0, ratio));
        ProjectedVertex { x: p[0], y: p[1], zs: rng.unit() as f32, q, varying: signed(rng, sizes) }
    };
    let (i, j) = (any(false), any(true));
    let at = |v: &ProjectedVertex<f32>| from_f32([v.x, v.y][axis] * sign) - from_f32(bound);
    let [di, dj] = [at(&i), at(&j)];
    let polygon = clip_sides(Polygon::triangle([i, j, i]), SideBounds { x: bound, y: bound });
    let cut = polygon.vertices()[1];
    assert_eq!([cut.x, cut.y][axis], sign * bound);
    if varying {
        let [qi, qj] = [i.q, j.q].map(from_f32);
        let exact: Rational = clip_lerp(&(&qi * from_f32(i.varying)), &(&qj * from_f32(j.varying)), &di, &dj)
            / clip_lerp(&qi, &qj, &di, &dj);
        return Sample::new(cut.varying, &exact, scale(i.varying, j.varying));
    }
    let parts = |v: &ProjectedVertex<f32>| [[v.y, v.x][axis], v.zs, v.q];
    let (got, a, b) = (parts(&cut), parts(&i), parts(&j));
    let [other, zs, q] = [0, 1, 2].map(|k| {
        let exact = clip_lerp(&from_f32(a[k]), &from_f32(b[k]), &di, &dj);
        Sample::new(got[k], &exact, scale(a[k], b[k]))
    });
    other.worst(zs).worst(q)
}
