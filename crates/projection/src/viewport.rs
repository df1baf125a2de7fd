//! Step 6: window-viewport, and the snapping of screen positions.

use crate::{SideBounds, ViewError};
use alberti_math::lanes::Lanes;
use alberti_math::{Fixed, GUARD_PIXELS, Subpixel, map2};
use core::ops::Range;

/// A rectangle of pixels on the target, in which the window [-1, 1] x [-1, 1] appears.
///
/// Pixel rows count from the top, so ys = 1 is the upper edge of the viewport's first row.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "crate::form::Rectangle", into = "crate::form::Rectangle"))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Viewport {
    /// Twice the centre, so that odd sizes have an integer one.
    center: [i32; 2],
    /// First and one past the last column, and row.
    edges: [[i32; 2]; 2],
    half: [f32; 2],
}

/// The greatest distance of a viewport's pixels from the frame's origin: half the guard band, so that the other half is
/// room for triangles that reach out of it.
const REACH: i32 = GUARD_PIXELS / 2;

impl Viewport {
    /// The viewport of `width` x `height` pixels whose top left pixel is (`x`, `y`).
    ///
    /// # Errors
    /// [`ViewError::Viewport`] if it is empty, or reaches more than 16384 pixels from the origin in any direction.
    pub fn new(x: i32, y: i32, width: u32, height: u32) -> Result<Self, ViewError> {
        let axis = |from: i32, length: u32| {
            let length = i32::try_from(length).ok()?;
            let to = from.checked_add(length)?;
            (length > 0 && from >= -REACH && to <= REACH).then_some([from, to])
        };
        let (Some(x), Some(y)) = (axis(x, width), axis(y, height)) else {
            return Err(ViewError::Viewport);
        };
        #[expect(clippy::cast_precision_loss, reason = "at most 2^15, so the half is exact")]
        let half = [width as f32 / 2.0, height as f32 / 2.0];
        Ok(Self { center: [x, y].map(|[from, to]| from + to), edges: [x, y], half })
    }

    /// The columns and the rows of its pixels.
    #[must_use]
    pub const fn pixels(&self) -> [Range<i32>; 2] {
        let [[left, right], [top, bottom]] = self.edges;
        [left..right, top..bottom]
    }

    /// The centre, in subpixels.
    #[must_use]
    #[inline]
    pub const fn center(&self, subpixel: Subpixel) -> [i32; 2] {
        let [x, y] = self.center;
        [x << (subpixel.bits() - 1), y << (subpixel.bits() - 1)]
    }

    /// The aspect ratio, width / height, of square pixels.
    #[must_use]
    pub const fn aspect(&self) -> f32 {
        self.half[0] / self.half[1]
    }

    /// The snapped screen position of a point of the window: xv = (xs + 1) W/2 + x0, yv = (1 − ys) H/2 + y0, to the
    /// nearest subpixel. `None` beyond the guard band and for NaN.
    ///
    /// That is the window translated by (1, 1) and scaled by (W/2, H/2), to the corner (x0, y0). y is turned over, as
    /// rows count downwards: H − (ys + 1) H/2 = (1 − ys) H/2.
    ///
    /// Computed as the viewport's centre plus the rounded offset, so that moving a viewport by whole pixels moves
    /// every position by exactly as much.
    ///
    /// # Precision
    /// The offset is a correctly rounded product, within ε·|offset| (ε = 2^-24), plus 2^-(bits+1) pixel for the
    /// snapping. The first is 2^-15 pixel within a 1024 pixel viewport, and at most 2^-8 at the far edge of the guard
    /// band.
    #[must_use]
    #[inline]
    pub fn to_screen(&self, subpixel: Subpixel, xs: f32, ys: f32) -> Option<[Fixed; 2]> {
        let x = Fixed::snap(subpixel, self.center[0], xs * self.half[0])?;
        let y = Fixed::snap(subpixel, self.center[1], -(ys * self.half[1]))?;
        Some([x, y])
    }

    /// [`to_screen`](Self::to_screen) of several points, as the bits of [`Fixed`]: any beyond the
    /// [`guard`](Self::guard).
    #[must_use]
    #[inline(always)]
    pub fn to_screen_lanes<L: Lanes>(
        &self,
        lanes: L,
        subpixel: Subpixel,
        [xs, ys]: [L::Number; 2],
    ) -> [L::U32; 2] {
        let center = map2(self.center(subpixel), |center| Fixed::wrapping(center).to_bits());
        let [x, y] = map2(center, |center| lanes.word(center));
        let [half_x, half_y] = map2(self.half, |half| lanes.splat(half));
        let parts = subpixel.bits() + Fixed::PARTS;
        [lanes.floor_scaled(xs * half_x, parts) + x, lanes.floor_scaled(-(ys * half_y), parts) + y]
    }

    /// The largest |xs| and |ys| that [`to_screen`](Self::to_screen) keeps within the guard band, a pixel short of it.
    ///
    /// # Precision
    /// Within ε, relatively: correctly rounded quotients.
    #[must_use]
    pub fn guard(&self) -> SideBounds {
        let axis = |center: i32, half: f32| {
            #[expect(clippy::cast_precision_loss, reason = "at most 2^16, exact")]
            let room = (2 * GUARD_PIXELS - center.abs()) as f32 / 2.0;
            // Two roundings and the snap may add up to less than a pixel.
            (room - 1.0) / half
        };
        SideBounds { x: axis(self.center[0], self.half[0]), y: axis(self.center[1], self.half[1]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::{Sub4, Sub8};

    fn screen(view: Viewport, xs: f32, ys: f32) -> [f32; 2] {
        let to_pixels = |c: Fixed| f32::from(i16::try_from(c.subpixels()).expect("small")) / 256.0;
        view.to_screen(Sub8, xs, ys).expect("inside").map(to_pixels)
    }

    #[test]
    fn the_window_fills_the_viewport_with_y_down() {
        let view = Viewport::new(10, 20, 64, 33).expect("valid");
        assert_eq!(screen(view, -1.0, 1.0), [10.0, 20.0]);
        assert_eq!(screen(view, 1.0, -1.0), [74.0, 53.0]);
        assert_eq!(screen(view, 0.0, 0.0), [42.0, 36.5]);
    }

    #[test]
    fn moving_a_viewport_moves_every_position_by_as_much() {
        let here = Viewport::new(0, 0, 641, 479).expect("valid");
        let there = Viewport::new(-7, 1001, 641, 479).expect("valid");
        for i in 0..10_000u16 {
            let (xs, ys) = (f32::from(i) / 4999.3 - 1.0, 1.0 - f32::from(i) / 7001.7);
            let [[x, y], [u, v]] =
                [here, there].map(|view| view.to_screen(Sub8, xs, ys).expect("inside").map(Fixed::subpixels));
            assert_eq!([u - x, v - y], [-7 * 256, 1001 * 256]);
        }
    }

    #[test]
    fn what_the_guard_admits_can_be_snapped() {
        for (x, y, w, h) in
            [(0, 0, 1, 1), (0, 0, 320, 240), (-16384, -16384, 32768, 32768), (16383, -5, 1, 9)]
        {
            let view = Viewport::new(x, y, w, h).expect("valid");
            let bounds = view.guard();
            assert!(bounds.x >= 1.0 - 1e-3 && bounds.y >= 1.0 - 1e-3);
            for sign in [-1.0, 1.0] {
                assert!(view.to_screen(Sub8, sign * bounds.x, sign * bounds.y).is_some());
                assert!(view.to_screen(Sub4, sign * bounds.x, -sign * bounds.y).is_some());
            }
        }
    }

    #[test]
    fn empty_and_remote_viewports_are_refused() {
        for (x, y, w, h) in
            [(0, 0, 0, 1), (0, 0, 1, 0), (0, 0, 16385, 1), (-16385, 0, 9, 9), (i32::MAX, 0, 9, 9)]
        {
            assert_eq!(Viewport::new(x, y, w, h), Err(ViewError::Viewport));
        }
    }
}
