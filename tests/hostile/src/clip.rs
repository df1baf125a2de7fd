//! The clip: what is left of triangles, exactly inside, with the same bits for neighbours, and nothing lost.

use crate::bits::Bits;
use alberti_math::glam::Vec3;
use alberti_math::{Eye, Point3};
use alberti_oracle::rational::{Rational, from_f32, from_int, to_f64};
use alberti_projection::{
    EyeVertex, MAX_POLYGON, Polygon, ProjectedVertex, SideBounds, clip_near_far, clip_sides,
};

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    if bits.bit() { near_far(&mut bits) } else { sides(&mut bits) }
}

/// The greatest coordinate for which the clip promises something.
const MOST: f32 = f32::MAX / 16.0;

fn eye(v: [f32; 4]) -> EyeVertex<f32> {
    EyeVertex { position: Point3::<Eye>::new(Vec3::new(v[0], v[1], v[2])), varying: v[3] }
}

fn values(v: &EyeVertex<f32>) -> [f32; 4] {
    let [x, y, z] = v.position.coords.to_array();
    [x, y, z, v.varying]
}

fn near_far(bits: &mut Bits<'_>) {
    let mut planes: [f32; 2] = bits.floats();
    planes.sort_by(f32::total_cmp);
    let [near, far] = planes;
    let corners: [[f32; 4]; 4] = [(); 4].map(|()| {
        let mut v: [f32; 4] = bits.floats();
        // Often just beside a plane, or on it.
        if bits.byte() < 64 {
            let at = if bits.bit() { near } else { far };
            v[2] = f32::from_bits(at.to_bits().wrapping_add_signed(bits.between(-2, 2) as i32));
        }
        v
    });
    let [a, b, c, d] = corners;
    let clip = |t: [[f32; 4]; 3]| clip_near_far(t.map(eye), near, far);
    let polygon = clip([a, b, c]);
    let left = polygon.vertices();
    assert!(left.len() <= 5 && left.len() != 1 && left.len() != 2, "{} vertices", left.len());
    let sound = |v: &[f32; 4]| v.iter().all(|x| x.abs() <= MOST);
    if !(corners.iter().all(sound) && near < far && near.is_finite()) {
        return;
    }
    for v in left {
        let v = values(v);
        assert!(v[2] >= near && v[2] <= far, "z {} of {near} to {far}", v[2]);
        for k in 0..4 {
            let ends = [a[k], b[k], c[k]];
            let [least, most] =
                [ends.iter().fold(f32::MAX, |m, x| m.min(*x)), ends.iter().fold(f32::MIN, |m, x| m.max(*x))];
            assert!(v[k] >= least && v[k] <= most, "{} is beyond {ends:?}", v[k]);
        }
    }
    // A triangle within is untouched, and clipping twice is clipping once.
    if [a, b, c].iter().all(|v| v[2] >= near && v[2] <= far) {
        assert!(left.iter().map(values).eq([a, b, c]));
    }
    for part in polygon.fan() {
        let again = clip_near_far(part, near, far);
        assert!(again.vertices().iter().map(values).eq(part.iter().map(values)));
    }
    area([a, b, c], left, [near, far]);
    // The neighbour across an edge walks it the other way, and has the same vertices on it.
    let neighbour = clip([b, a, d]);
    for v in left.iter().map(values).filter(|v| v[2] == near || v[2] == far) {
        let on_edge = crossing(a, b, v[2]) && !crossing(b, c, v[2]) && !crossing(c, a, v[2]);
        if on_edge && [a, b, c].iter().all(|corner| *corner != v) {
            let same =
                neighbour.vertices().iter().map(values).any(|w| w.map(f32::to_bits) == v.map(f32::to_bits));
            assert!(same, "neighbours differ in {v:?} of {a:?} {b:?}");
        }
    }
}

/// Whether an edge has its ends on two sides of a plane, or one of them on it.
fn crossing(a: [f32; 4], b: [f32; 4], plane: f32) -> bool {
    (a[2] - plane).signum() != (b[2] - plane).signum() || a[2] == plane || b[2] == plane
}

/// Twice the area of a polygon in the plane of two axes, exactly.
fn doubled(polygon: &[[Rational; 2]]) -> Rational {
    let mut sum = from_int(0);
    for (k, [x, y]) in polygon.iter().enumerate() {
        let [next_x, next_y] = &polygon[(k + 1) % polygon.len()];
        sum += x * next_y - y * next_x;
    }
    sum
}

/// The area that is left, seen along y, against the same clip in rationals.
fn area(triangle: [[f32; 4]; 3], left: &[EyeVertex<f32>], planes: [f32; 2]) {
    let mut exact: Vec<[Rational; 2]> = triangle.iter().map(|v| [from_f32(v[0]), from_f32(v[2])]).collect();
    for (plane, inner) in planes.into_iter().zip([1, -1]).filter(|(plane, _)| plane.is_finite()) {
        let distance = |p: &[Rational; 2]| (&p[1] - from_f32(plane)) * from_int(inner);
        let mut clipped = Vec::new();
        for (k, at) in exact.iter().enumerate() {
            let next = &exact[(k + 1) % exact.len()];
            let (d, e) = (distance(at), distance(next));
            let zero = from_int(0);
            if d >= zero {
                clipped.push(at.clone());
            }
            if (d >= zero) != (e >= zero) && d != zero && e != zero {
                let share = &d / (&d - &e);
                clipped.push([0, 1].map(|i: usize| &at[i] + (&next[i] - &at[i]) * &share));
            }
        }
        exact = clipped;
    }
    let found: Vec<[Rational; 2]> =
        left.iter().map(values).map(|v| [from_f32(v[0]), from_f32(v[2])]).collect();
    let size = |k: usize| triangle.iter().map(|v| f64::from(v[k].abs())).fold(0.0, f64::max);
    // Each cut is within 4ε of the larger end on each axis; and nothing is promised below the least normal number.
    let unit = 2f64.powi(-24) * 4.0 * 2.0 * 4.0;
    let slack = unit * size(0).max(1e-37) * size(2).max(1e-37);
    let off = to_f64(&(doubled(&found) - doubled(&exact))).abs();
    assert!(
        off <= slack,
        "an area of {off} is lost or gained, {slack} is the most: {triangle:?} in {planes:?}"
    );
}

fn sides(bits: &mut Bits<'_>) {
    let bound = [(); 2].map(|()| bits.float().abs());
    let corner = |bits: &mut Bits<'_>| {
        let [x, y] = bits.floats();
        let (zs, q) = (f32::from(bits.byte()) / 255.0, bits.float().abs());
        ProjectedVertex { x, y, zs, q, varying: bits.float() }
    };
    let triangle = [corner(bits), corner(bits), corner(bits)];
    let bounds = SideBounds { x: bound[0], y: bound[1] };
    let polygon = clip_sides(Polygon::triangle(triangle), bounds);
    let left = polygon.vertices();
    assert!(left.len() <= MAX_POLYGON && left.len() != 1 && left.len() != 2);
    let sound = |v: &ProjectedVertex<f32>| {
        v.x.abs() <= MOST && v.y.abs() <= MOST && v.varying.abs() <= MOST && v.q > 1e-30 && v.q < 1e30
    };
    if !triangle.iter().all(sound) || bound.iter().any(|b| !b.is_finite()) {
        return;
    }
    for v in left {
        assert!(v.x.abs() <= bound[0] && v.y.abs() <= bound[1], "{v:?} is beyond {bound:?}");
        assert!(v.q > 0.0 && (0.0..=1.0).contains(&v.zs) && v.varying.is_finite(), "{v:?}");
        let ends = triangle.map(|corner| corner.varying);
        let within = ends.iter().any(|e| *e <= v.varying) && ends.iter().any(|e| *e >= v.varying);
        assert!(within, "{} is beyond {ends:?}", v.varying);
    }
    if triangle.iter().all(|v| v.x.abs() <= bound[0] && v.y.abs() <= bound[1]) {
        assert_eq!(left, triangle);
    }
    let again = clip_sides(polygon, bounds);
    assert_eq!(again.vertices(), left, "clipping twice is clipping once");
}
