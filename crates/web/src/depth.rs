//! Station 2: two planes that fight for pixels, and the resolution of depth formats.
//!
//! A road lies on the ground, `gap` above it, and both run to the far plane. The eye is 1 above the ground, so that
//! surfaces on one ray are apart by `gap` times their depth.
//!
//! ```text
//!   parameters  0 1 logarithms of near, far   2 format   3 logarithm of the gap
//!   results     0 near   1 far   2 gap   3 α   4 β   5 pixels of the road that show the ground   6 pixels of the road
//!               7 depth from which they may fight, or 0   8.. SAMPLES depths, and dz of each format at these
//! ```

use crate::canvas::Canvas;
use crate::numbers::{float, power_of_ten, whole};
use crate::shading::{QUAD, plain};
use crate::{Drawn, Fault, Parameters};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::One;
use alberti::projection::{DepthMap, DepthSteps};
use alberti::*;
use alloc::vec::Vec;
use core::f32::consts::FRAC_PI_2;

/// The formats of the page, with the steps that they have.
const FORMATS: [(AnyDepth, DepthSteps); 4] = [
    (AnyDepth::D16, DepthSteps::D16),
    (AnyDepth::D24, DepthSteps::D24),
    (AnyDepth::F32, DepthSteps::F32),
    (AnyDepth::F32Reversed, DepthSteps::F32),
];

/// Points of each curve.
const SAMPLES: usize = 49;

/// The nearest part of the road, which is at the lower end of the picture.
const BEGIN: f32 = 0.9;

pub(crate) fn draw(canvas: &mut Canvas, results: &mut Vec<f32>, parameters: &Parameters) -> Drawn {
    let [log_near, log_far, format, log_gap, ..] = *parameters;
    let [near, far, gap] = [log_near, log_far, log_gap].map(power_of_ten);
    // The depth at a share of the way between the logarithms of the planes.
    let depth_at = |share: f32| power_of_ten(log_near + share * (log_far - log_near)).max(near).min(far);
    let (format, steps) = FORMATS[whole(format, 3) as usize];
    let map = if format.reversed() { DepthMap::reversed(near, far)? } else { DepthMap::forward(near, far)? };

    // Without depths the road is drawn over the ground: so it should be.
    let road = scene(canvas, AnyDepth::NoDepth, [near, far, gap])?;
    let expected = canvas.kept();
    scene(canvas, format, [near, far, gap])?;
    let wrong = canvas.pixels().iter().zip(&expected).filter(|(found, expected)| found != expected).count();

    results.extend([near, far, gap, map.alpha(), map.beta(), float(wrong), float(road)]);
    results.push(fight(&map, steps, gap, depth_at));
    let depths: Vec<f32> = (0..SAMPLES).map(|k| depth_at(float(k) / float(SAMPLES - 1))).collect();
    results.extend(&depths);
    for (format, steps) in FORMATS {
        let map =
            if format.reversed() { DepthMap::reversed(near, far)? } else { DepthMap::forward(near, far)? };
        results.extend(depths.iter().map(|&z| map.resolution(steps, z)));
    }
    Ok(())
}

/// Draws both planes, and returns the pixels of the road.
fn scene(canvas: &mut Canvas, format: AnyDepth, [near, far, gap]: [f32; 3]) -> Result<usize, Fault> {
    let [width, height] = canvas.size();
    // The horizon is high in the picture: a viewport that reaches out of it.
    let above = (height * 7 / 10).cast_signed();
    let viewport = Viewport::new(0, -above, width, height + above.unsigned_abs())?;
    let mut target = canvas.target_of(format)?;
    let view = View::new(Frame::IDENTITY, Perspective::new(FRAC_PI_2, viewport.aspect(), near, far)?);
    let begin = BEGIN.max(near);
    let plane = |y: f32, sides: [f32; 2]| {
        let [first, last] = sides;
        [(-first, begin), (first, begin), (last, far), (-last, far)].map(|(x, z)| (Vec3::new(x, y, z), z))
    };
    let ground = plane(-1.0, [3.0 * begin, 3.0 * far]);
    let road = plane(gap - 1.0, [1.3, 1.3]);
    let mut draw = |corners: [(Vec3, f32); 4], colors: [u32; 2]| {
        let mesh = plain(&corners, &QUAD);
        // Stripes of equal ratios of depth, two for each doubling, from the number's bits.
        let stage = move |z: f32| Some(Rgba8::from_rgb24(colors[(z.to_bits() >> 22 & 1) as usize]));
        let mut stats = Stats::default();
        Pass::new(&view, &mesh, stage).viewport(viewport).cull(Cull::None).count_by(
            One,
            &mut target,
            &mut stats,
        );
        stats
    };
    draw(ground, [0x34_6a_b8, 0x2d_5c_a2]);
    let stats = draw(road, [0xf2_a5_3c, 0xd9_8c_28]);
    Ok(usize::try_from(stats.fragments).unwrap_or(usize::MAX))
}

/// The least depth at which the resolution is no better than the distance of the planes along a ray, by bisection; 0
/// if there is none.
fn fight(map: &DepthMap, steps: DepthSteps, gap: f32, depth_at: impl Fn(f32) -> f32) -> f32 {
    let fights = |z: f32| map.resolution(steps, z) >= gap * z;
    let mut range = Vec2::new(0.0, 1.0);
    if !fights(depth_at(1.0)) {
        return 0.0;
    }
    for _ in 0..24 {
        let middle = (range.x + range.y) / 2.0;
        if fights(depth_at(middle)) {
            range.y = middle;
        } else {
            range.x = middle;
        }
    }
    depth_at(range.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Page, Station};

    fn results(near: f32, far: f32, format: f32, gap: f32) -> Vec<f32> {
        let mut page = Page::new();
        let mut parameters = [0.0; crate::PARAMETERS];
        parameters[..4].copy_from_slice(&[near, far, format, gap]);
        page.draw(Station::Depth, [320, 240], &parameters).unwrap();
        page.results
    }

    #[test]
    fn sixteen_bits_fight_and_reversed_floats_do_not() {
        let d16 = results(-2.0, 4.0, 0.0, -2.0);
        assert!(d16[5] > 0.004 * d16[6] && d16[7] > 0.0, "{:?}", &d16[..8]);
        let reversed = results(-2.0, 4.0, 3.0, -2.0);
        assert_eq!((reversed[5], reversed[7]), (0.0, 0.0));
    }

    #[test]
    fn the_map_has_its_coefficients() {
        let found = results(0.0, 2.0, 1.0, -2.0);
        assert!((found[3] - 100.0 / 99.0).abs() < 1e-5 && (found[4] + 100.0 / 99.0).abs() < 1e-5);
        assert_eq!(found.len(), 8 + 5 * SAMPLES);
    }

    #[test]
    fn planes_in_the_wrong_order_are_refused() {
        let mut page = Page::new();
        let parameters = [2.0; crate::PARAMETERS];
        assert!(page.draw(Station::Depth, [64, 48], &parameters).is_err());
    }
}
