//! Vertices in integers against the same matrix in `f64`.

use super::*;
use alberti_math::glam::{Mat3, Quat, Vec3};
use alberti_math::{Point3, Sub4, Sub8};
use alberti_oracle::rng::{Rng, run_seed};
use alberti_projection::{AnyProjection, Parallel, Perspective};
use core::f64::consts::PI;
use std::println;

/// A mesh before an eye.
#[derive(Debug)]
struct Scene {
    to_eye: Frame<Object, Eye>,
    unit: f32,
    projection: AnyProjection,
    planes: [f32; 2],
    size: [u32; 2],
    subpixel: Subpixel,
    depth_bits: u32,
    reversed: bool,
}

#[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
fn scene(rng: &mut Rng) -> Scene {
    let unit = rng.log_uniform(1e-7, 1e2);
    let extent = f64::from(unit) * 32768.0;
    let turn = Quat::from_scaled_axis(Vec3::from_array([(); 3].map(|()| rng.uniform(-PI, PI) as f32)));
    let axes = Mat3::from_quat(turn) * rng.uniform(0.5, 2.0) as f32;
    let away = f64::from(rng.log_uniform(0.01, 30.0)) * extent;
    let aside = [(); 2].map(|()| (rng.uniform(-1.0, 1.0) * extent) as f32);
    let to_eye = Frame::from_mat3(axes, Point3::new(Vec3::new(aside[0], aside[1], away as f32)));
    let near = rng.log_uniform(1e-4, 1.0) * extent as f32;
    let parallel = rng.one_in(4);
    let planes = if parallel && rng.one_in(2) {
        // Behind the eye, or far beyond the mesh on both sides.
        let behind = rng.log_uniform(1e-3, 1e3) * extent as f32;
        [-behind, behind * rng.log_uniform(0.1, 10.0)]
    } else {
        [near, near * rng.log_uniform(1.5, 1e6)]
    };
    let size = [(); 2].map(|()| u32::try_from(rng.log_integer(2048)).expect("small").max(1));
    let aspect = rng.log_uniform(0.3, 3.0);
    let projection = if parallel {
        Parallel::new(rng.uniform(0.1, 4.0) as f32 * extent as f32, aspect, planes[0], planes[1])
            .expect("a box")
            .into()
    } else {
        let angle = rng.uniform(0.1, 2.5) as f32;
        Perspective::new(angle, aspect, planes[0], planes[1]).expect("a pyramid").into()
    };
    let subpixel = if rng.one_in(2) { Sub4 } else { Sub8 };
    let depth_bits = [16, 24, 31][rng.index(3)];
    Scene { to_eye, unit, projection, planes, size, subpixel, depth_bits, reversed: rng.one_in(2) }
}

/// A vertex in exact arithmetic, as good as.
struct Exact {
    /// In units of 1/w.
    place: [f64; 2],
    w: f64,
    z: f64,
    zs: f64,
    /// The greatest coordinate that the mesh may have, in the units of w, and in those of z.
    greatest: [f64; 2],
}

impl Scene {
    fn exact(&self, position: [i16; 3]) -> Exact {
        let scales = self.projection.scale_lanes(One, [1.0; 3]).map(f64::from);
        let axes = self.to_eye.axes().transpose();
        let origin = self.to_eye.origin().coords.to_array().map(f64::from);
        let rows = [axes.x_axis, axes.y_axis, axes.z_axis].map(|row| row.to_array().map(f64::from));
        let unit = f64::from(self.unit);
        let at = |axis: usize| {
            let sum = (0..3).map(|k| rows[axis][k] * f64::from(position[k])).sum::<f64>();
            (sum * unit + origin[axis]) * scales[axis]
        };
        let reach = |axis: usize| {
            (rows[axis].iter().map(|c| c.abs()).sum::<f64>() * 32768.0 * unit + origin[axis].abs())
                * scales[axis]
        };
        let perspective = self.projection.is_perspective();
        let (x, y, z) = (at(0), at(1), at(2));
        let w = if perspective { z } else { 1.0 };
        let [near, far] = self.planes.map(f64::from);
        let zs = if perspective { far / (far - near) * (1.0 - near / z) } else { (z - near) / (far - near) };
        let greatest =
            if perspective { reach(0).max(reach(1)).max(reach(2)) } else { reach(0).max(reach(1)).max(2.0) };
        // In parallel projection depths are in a unit of their own.
        let greatest = [greatest, if perspective { greatest } else { greatest * reach(2) }];
        Exact { place: [x / w, y / w], w, z, zs: if self.reversed { 1.0 - zs } else { zs }, greatest }
    }
}

#[test]
fn vertices_are_where_the_bound_says() {
    let mut rng = Rng::stream(run_seed(), 61);
    let (mut seen, mut none, mut worst, mut worst_near) = ([0u32; 3], 0, 0.0f64, 0.0f64);
    for _ in 0..30_000 {
        let scene = scene(&mut rng);
        let viewport = Viewport::new(-7, 11, scene.size[0], scene.size[1]).expect("a viewport");
        let way = IntegerScreen::new(
            (&scene.to_eye, scene.unit),
            &scene.projection,
            (&viewport, scene.subpixel, Sides::GuardBand),
            (scene.depth_bits, scene.reversed),
        );
        let Some(way) = way else {
            none += 1;
            continue;
        };
        let one = f64::from(1 << scene.subpixel.bits());
        let halves = scene.size.map(|pixels| f64::from(pixels) * one / 2.0);
        let center = viewport.center(scene.subpixel).map(f64::from);
        let guard = viewport.guard();
        for _ in 0..20 {
            #[expect(clippy::cast_possible_truncation, reason = "in range")]
            let position = [(); 3].map(|()| rng.range(-32768, 32767) as i16);
            let exact = scene.exact(position);
            let place = way
                .place(&scene.projection, position)
                .unwrap_or_else(|| way.beyond(&scene.projection, position));
            // Two of 2^29 units, and three roundings of the factors.
            let [lost, lost_z] = exact.greatest.map(|c| c * (2.0f64.powi(-28) + 2.0f64.powi(-22)));
            let planes = [
                (outside::NEAR, f64::from(scene.planes[0]) - exact.z),
                (outside::FAR, exact.z - f64::from(scene.planes[1])),
            ];
            for (bit, beyond) in planes {
                let lost = lost_z + 1e-6 * exact.z.abs();
                // Floats decide next to a plane.
                let doubt = exact.greatest[1] * 2.0f64.powi(-19);
                if beyond.abs() > lost && (beyond < 0.0 || beyond > lost + doubt) {
                    assert_eq!(place.outside & bit != 0, beyond > 0.0, "{bit} of {position:?} in {scene:?}");
                } else if beyond > lost {
                    let clipped = place.outside & (bit | outside::GUARD) != 0;
                    assert!(clipped, "{bit} of {position:?} in {scene:?}");
                }
            }
            let [x, y] = exact.place.map(|c| c * exact.w);
            let sides = [
                (outside::LEFT, -exact.w - x),
                (outside::RIGHT, x - exact.w),
                (outside::BELOW, -exact.w - y),
                (outside::ABOVE, y - exact.w),
            ];
            for (bit, beyond) in sides {
                if beyond.abs() > 2.0 * lost + 1e-6 * exact.w.abs() {
                    assert_eq!(place.outside & bit != 0, beyond > 0.0, "{bit} of {position:?} in {scene:?}");
                }
            }
            if place.outside & (outside::NEAR | outside::FAR) != 0 {
                continue;
            }
            let bounds = [guard.x, guard.y].map(f64::from);
            if place.outside & outside::GUARD != 0 {
                let planes = scene.planes.map(f64::from);
                let near = [0, 1].iter().any(|&k| exact.place[k].abs() > bounds[k] * 0.98 - 0.1);
                let doubtful = planes.iter().any(|plane| (plane - exact.z).abs() < exact.greatest[1] * 1e-5);
                assert!(near || doubtful, "{position:?} in {scene:?}: {:?}", exact.place);
                seen[2] += 1;
                continue;
            }
            let sign = [1.0, -1.0];
            for k in 0..2 {
                assert!(exact.place[k].abs() <= bounds[k] + lost / exact.w * (1.0 + bounds[k]));
                let expected = center[k] + sign[k] * exact.place[k] * halves[k];
                let error = (f64::from(place.place[k]) - expected).abs();
                let size = exact.place[k].abs();
                let off = lost / exact.w * (1.0 + size) + size * 2.0f64.powi(-28) + 2.0f64.powi(-28);
                assert!(error <= 0.5 + off * halves[k], "{error} at {position:?} in {scene:?}");
                worst = worst.max((error - 0.5) / (off * halves[k]));
                // The module's promise.
                if size <= 1.0 && halves[k] * exact.greatest[0] / exact.w <= 2.0f64.powi(20) {
                    worst_near = worst_near.max(error);
                }
            }
            // The buffer's rounding, as floats have it.
            let step = if scene.depth_bits > 24 { 0.0 } else { 0.5f64.powi(scene.depth_bits.cast_signed()) };
            let zs = exact.zs * (1.0 - step) + step / 2.0;
            let found = f64::from(place.depths[0]) / 2.0f64.powi(31);
            let near = f64::from(scene.planes[0]);
            let slope = if scene.projection.is_perspective() {
                2.0 * near / (exact.z * exact.z)
            } else {
                1.0 / f64::from(scene.planes[1] - scene.planes[0])
            };
            let off = 2.0f64.powi(-22) + slope * lost_z;
            assert!((found - zs).abs() <= off, "depth {found} for {zs} at {position:?} in {scene:?}");
            let q = f64::from(f32::from_bits(place.depths[1])) * exact.w;
            assert!((q - 1.0).abs() <= 2.0f64.powi(-22) + lost / exact.w, "{q} at {position:?} in {scene:?}");
            seen[usize::from(place.outside != 0)] += 1;
        }
    }
    println!("in the view, beside it, beyond the guard band: {seen:?}; {none} scenes in floats");
    println!("{worst:.3} of the bound, {worst_near:.3} subpixels");
    assert!(seen.iter().all(|&n| n > 500) && (1..2_000).contains(&none), "{seen:?}, {none}");
    assert!(worst > 0.05 && worst_near <= 0.75);
}
