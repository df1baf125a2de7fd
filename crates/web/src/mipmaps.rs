//! Station 4: a floor to the horizon under filters of mip maps.
//!
//! ```text
//!   parameters  0 filter: nearest, bilinear, trilinear, anisotropic   1 logarithm of the probes   2 bias of λ
//!               3 height of the eye   4 look down, degrees   5 whether levels are coloured
//!               6 7 the pointer, in pixels
//!   results     0 λ at the pointer   1 2 the axes of its pixel, the longer first, in texels   3 its distance;
//!               all of them 0 above the horizon
//! ```

use crate::canvas::Canvas;
use crate::numbers::{narrow, turn, whole};
use crate::shading::{QUAD, plain};
use crate::textures::{BOARD, Textures};
use crate::{Drawn, Parameters};
use alberti::glam::{DVec2, DVec3, Vec2, Vec3};
use alberti::lanes::One;
use alberti::shaders::Unlit;
use alberti::texture::{AnyFilter, AnyMipFilter, Bounded, LodBounds, Repeat};
use alberti::*;
use alloc::vec::Vec;

/// The full vertical opening angle, radians.
const FOV: f32 = 0.9;

/// The side of the texture on the floor.
const TILE: f32 = 2.0;

pub(crate) fn draw(
    canvas: &mut Canvas,
    results: &mut Vec<f32>,
    textures: &mut Textures,
    parameters: &Parameters,
) -> Drawn {
    let [filter, probes, bias, height, down, colored, x, y, ..] = *parameters;
    let filter = match whole(filter, 3) {
        0 => AnyMipFilter::Base(AnyFilter::Nearest),
        1 => AnyMipFilter::Base(AnyFilter::Bilinear),
        2 => AnyMipFilter::Trilinear,
        _ => AnyMipFilter::Anisotropic { probes: 1 << whole(probes, 4) },
    };
    let levels = if colored > 0.5 { textures.levels()? } else { textures.board()? };
    let bounds = LodBounds { bias, ..LodBounds::default() };
    let stage = Unlit(levels.mipmap()?.sampler(Bounded { filter, bounds }, Repeat));

    let eye = Vec3::new(0.37, height.max(0.05), 0.0);
    let [cos, sin] = turn(down);
    let forward = Vec3::new(0.0, -sin, -cos);
    let camera = Camera::look_at(eye, eye + forward, Vec3::Y)?;
    let view = camera.perspective(FOV, 0.02..400.0)?;
    let corners = [(-200.0, 2.0), (200.0, 2.0), (200.0, -300.0), (-200.0, -300.0)];
    let corners = corners.map(|(x, z)| (Vec3::new(x, 0.0, z), Vec2::new(x, -z) / TILE));
    alberti::draw(&mut canvas.flat()?, &view, &plain(&corners, &QUAD), stage);
    let pointer = DVec2::new(f64::from(x), f64::from(y));
    let [width, height] = canvas.size();
    let lens = view.projection(&Viewport::new(0, 0, width, height)?);
    results.extend(covered(canvas.size(), &lens, [eye, forward], pointer));
    Ok(())
}

/// λ, the axes in texels and the distance at a pixel, of the floor by rays in `f64`: derivatives are differences of
/// rays a thousandth of a pixel apart.
fn covered(
    [width, height]: [u32; 2],
    lens: &Perspective,
    [eye, forward]: [Vec3; 2],
    pixel: DVec2,
) -> [f32; 4] {
    const STEP: f64 = 1.0 / 1024.0;
    let (eye, forward) = (eye.as_dvec3(), forward.as_dvec3());
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    // The pyramid's scale is the cotangent of half the angle.
    let cotangent = f64::from(lens.scale(Point3::new(Vec3::new(0.0, 1.0, 1.0))).coords.y);
    let scale = 2.0 / (cotangent * f64::from(height));
    let meet = |pixel: DVec2| {
        let offset = (pixel + 0.5 - DVec2::new(f64::from(width), f64::from(height)) / 2.0) * scale;
        let ray = forward + right * offset.x - up * offset.y;
        let distance = -eye.y / ray.y;
        (eye + ray * distance, distance)
    };
    let (_, distance) = meet(pixel);
    if !(distance > 0.0 && distance < 300.0 && pixel.x >= 0.0) {
        return [0.0; 4];
    }
    let slope = |step: DVec2| {
        let difference = (meet(pixel + step).0 - meet(pixel - step).0) / (2.0 * STEP * f64::from(TILE));
        [narrow(difference.x), narrow(-difference.z)]
    };
    let gradient = Gradient { dx: slope(DVec2::new(STEP, 0.0)), dy: slope(DVec2::new(0.0, STEP)) };
    let lambda = gradient.lod_lanes(One, [BOARD; 2]);
    let axes = gradient.axes_lanes(One, [BOARD; 2]).log2_lengths_lanes(One, [BOARD; 2]);
    let [across, down] = axes.map(|log| narrow(libm::exp2(f64::from(log))));
    [lambda, across.max(down), across.min(down), narrow(distance)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_rises_with_the_distance() {
        let lens = Perspective::new(FOV, 4.0 / 3.0, 0.1, 100.0).unwrap();
        let at = |row: f64| {
            covered([640, 480], &lens, [Vec3::Y, Vec3::new(0.0, 0.0, -1.0)], DVec2::new(320.0, row))
        };
        assert_eq!(at(100.0), [0.0; 4]);
        let (near, far) = (at(470.0), at(260.0));
        assert!(far[0] > near[0] + 3.0 && far[3] > near[3]);
        assert!(far[1] > 5.0 * far[2], "{far:?}");
    }
}
