//! Cameras, matrices, planes and viewports of any numbers: refused, or sound.

use crate::bits::Bits;
use alberti_math::glam::{Mat4, Vec3};
use alberti_math::{Eye, Frame, GUARD_PIXELS, Point3, Subpixel, Vector3, World};
use alberti_oracle::rational::{Rational, depth, depth_reversed, from_f32, to_f64};
use alberti_projection::{
    ClipSpace, DepthMap, Handedness, Homogeneous, Parallel, Perspective, Projector, Viewport, eye_of_matrix,
    look_at,
};

const EPSILON: f64 = 1.0 / 16_777_216.0;

pub(crate) fn run(bytes: &[u8]) {
    let mut bits = Bits::new(bytes);
    match bits.below(6) {
        0 => cameras(&mut bits),
        1 => matrices(&mut bits),
        2 => planes(&mut bits),
        3 => viewports(&mut bits),
        4 => projectors(&mut bits),
        _ => lenses(&mut bits),
    }
}

/// The axes of a frame are unit vectors, as far as each is known to be.
fn assert_unit(frame: &Frame<Eye, World>, bound: f64) {
    let axes = frame.axes();
    for axis in [axes.x_axis, axes.y_axis, axes.z_axis] {
        let length = axis.as_dvec3().length();
        assert!((length - 1.0).abs() <= bound, "{axis} is {length} long");
    }
    assert!(frame.origin().coords.is_finite());
}

fn cameras(bits: &mut Bits<'_>) {
    let [eye, target, up] = [(); 3].map(|()| Vec3::from_array(bits.floats()));
    let Ok(frame) = look_at(Point3::new(eye), Point3::new(target), Vector3::new(up)) else { return };
    assert_unit(&frame, 3.0 * EPSILON);
    let axes = frame.axes();
    let forward = (target - eye).as_dvec3().normalize();
    assert!(axes.z_axis.as_dvec3().distance(forward) <= 6.0 * EPSILON, "{eye} {target} {up}: {axes}");
    // Upwards is on the side of `up`, to the right of which is right.
    assert!(axes.y_axis.as_dvec3().dot(up.as_dvec3()) >= 0.0);
    assert!(axes.y_axis.cross(axes.z_axis).dot(axes.x_axis) < 0.0);
    assert!(axes.x_axis.dot(axes.z_axis).abs() < 0.01 && axes.x_axis.dot(axes.y_axis).abs() < 0.01);
}

fn matrices(bits: &mut Bits<'_>) {
    let matrix = Mat4::from_cols_array(&bits.floats());
    let handedness = bits.pick(&[Handedness::Right, Handedness::Left]);
    if let Ok(frame) = eye_of_matrix(matrix, handedness) {
        assert!(frame.origin().coords.is_finite());
        let axes = frame.axes();
        assert!([axes.x_axis, axes.y_axis, axes.z_axis].iter().all(|axis| axis.is_finite()));
    }
    let space = bits.pick(&[ClipSpace::OpenGl, ClipSpace::DirectX, ClipSpace::Vulkan]);
    if let Ok(view) = Perspective::from_matrix(matrix, space) {
        check_planes(view.near(), view.far());
    }
}

fn check_planes(near: f32, far: f32) {
    assert!(near > 0.0 && near < far && near.is_finite(), "{near} {far}");
}

fn lenses(bits: &mut Bits<'_>) {
    let [angle, aspect, near, far] = bits.floats();
    if let Ok(view) = Perspective::new(angle, aspect, near, far) {
        check_planes(near, far);
        let at = Point3::new(Vec3::from_array([bits.moderate(), bits.moderate(), 1.0]));
        let scaled = view.scale(at).coords;
        // Cotangents of angles to the last degree of f64, and what that makes of x and y.
        let exact = 1.0 / (f64::from(angle) / 2.0).tan() * f64::from(at.coords.y);
        let off = (f64::from(scaled.y) - exact).abs();
        assert!(off <= 1e-6 * exact.abs().max(1e-37) || exact.abs() > 1e37, "{angle}: {off} of {exact}");
    }
    if let Ok(view) = Parallel::new(angle, aspect, near, far) {
        assert!(near < far && near.is_finite() && far.is_finite() && angle > 0.0, "{view:?}");
    }
}

fn planes(bits: &mut Bits<'_>) {
    let [near, far] = bits.floats();
    let reversed = bits.bit();
    let map = if reversed { DepthMap::reversed(near, far) } else { DepthMap::forward(near, far) };
    let Ok(map) = map else { return };
    check_planes(near, far);
    let [first, last] = if reversed { [1.0, 0.0] } else { [0.0, 1.0] };
    let mut places = [(); 4].map(|()| {
        let share = f32::from(u16::from_le_bytes(bits.bytes())) / 65535.0;
        let z = match bits.byte() & 3 {
            0 => near + (far.min(1e30) - near) * share,
            1 => near * (1.0 + share),
            2 => far * share,
            _ => bits.float(),
        };
        if z >= near && z <= far { z } else { near }
    });
    places.sort_by(f32::total_cmp);
    let depths = places.map(|z| map.zs(z));
    for (z, zs) in places.into_iter().zip(depths) {
        assert!((0.0..=1.0).contains(&zs), "{z} of {near} to {far} is at {zs}");
        let exact =
            if far.is_infinite() { endless(z, near, reversed) } else { exact(z, near, far, reversed) };
        let slope = f64::from(map.beta()).abs() / f64::from(near);
        let bound = if reversed { 4.5 * (slope + 1.0) + 1.0 } else { 3.0 * slope + 0.5 };
        assert!(
            (f64::from(zs) - exact).abs() <= 1.001 * bound * EPSILON,
            "{z} of {near} to {far}: {zs} for {exact}"
        );
    }
    // A greater distance is never before a lesser one.
    let sorted = depths.windows(2).all(|pair| if reversed { pair[0] >= pair[1] } else { pair[0] <= pair[1] });
    assert!(sorted, "{places:?} in {near} to {far}: {depths:?}");
    let z = map.z(first + (last - first) * 0.5);
    assert!(z > 0.0, "{near} to {far}: {z}");
}

fn exact(z: f32, near: f32, far: f32, reversed: bool) -> f64 {
    to_f64(&if reversed { depth_reversed(z, near, far) } else { depth(z, near, far) })
}

/// Without a far plane: 1 − A/z, or A/z.
fn endless(z: f32, near: f32, reversed: bool) -> f64 {
    if z.is_infinite() {
        return if reversed { 0.0 } else { 1.0 };
    }
    let share: Rational = from_f32(near) / from_f32(z);
    if reversed { to_f64(&share) } else { 1.0 - to_f64(&share) }
}

fn viewports(bits: &mut Bits<'_>) {
    let [x, y] = [(); 2].map(|()| bits.word().cast_signed() >> bits.below(32));
    let [width, height] = [(); 2].map(|()| bits.word() >> bits.below(32));
    let Ok(viewport) = Viewport::new(x, y, width, height) else { return };
    let subpixel = bits.pick(&[Subpixel::Sub4, Subpixel::Sub8]);
    let [xs, ys]: [f32; 2] = bits.floats();
    let steps = f64::from(1 << subpixel.bits());
    let ends = [(x, width, xs), (y, height, -ys)];
    let exact =
        ends.map(|(from, length, s)| f64::from(from) + f64::from(length) / 2.0 * (1.0 + f64::from(s)));
    match viewport.to_screen(subpixel, xs, ys) {
        Some(place) => {
            for (found, (exact, (_, length, s))) in place.into_iter().zip(exact.into_iter().zip(ends)) {
                let off = (f64::from(found.subpixels()) - exact * steps).abs();
                let offset = f64::from(length) / 2.0 * f64::from(s).abs();
                assert!(off <= 0.5 + 1.01 * EPSILON * offset * steps, "{off} subpixels");
                assert!(found.subpixels().abs() <= GUARD_PIXELS << subpixel.bits());
            }
        }
        None => {
            let guard = f64::from(GUARD_PIXELS);
            let beyond = |exact: f64| !(exact > 1.0 - guard && exact < guard - 1.0);
            assert!(exact.into_iter().any(beyond), "{exact:?} is within the guard band");
        }
    }
}

fn projectors(bits: &mut Bits<'_>) {
    let [eye, target, point] = [(); 3].map(|()| Vec3::from_array(bits.floats()));
    let [angle, aspect] = bits.floats();
    let Ok(place) = look_at(Point3::new(eye), Point3::new(target), Vector3::new(Vec3::Y)) else { return };
    let Ok(projector) = Projector::new(place, angle, aspect) else { return };
    let Homogeneous { .. } = projector.project(Point3::new(point));
    if let Some(uv) = projector.project(Point3::new(point)).divide() {
        assert!(uv.is_finite(), "{uv}");
    }
}
