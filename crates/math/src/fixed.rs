//! Fixed-point screen coordinates, and the bound that keeps the edge functions built on them exact.

use crate::round::round_half_up;
use core::fmt;
use core::marker::PhantomData;

/// How many fraction bits a snapped coordinate has.
///
/// More bits follow a slowly moving vertex more smoothly (a vertex moves by at most 2^-(BITS+1) pixels when it is
/// snapped); fewer bits let larger triangles stay in 32-bit edge functions.
pub trait Subpixel: Copy + fmt::Debug + 'static {
    /// The number of fraction bits.
    const BITS: u32;
    /// One pixel, in subpixels.
    const ONE: i32 = 1 << Self::BITS;
    /// Half a pixel: where a pixel's sample lies within it.
    const HALF: i32 = Self::ONE / 2;
}

/// Four fraction bits (28.4): a vertex moves by at most 1/32 pixel; 32-bit edge functions up to about 2,890 pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sub4 {}

/// Eight fraction bits (24.8), what Direct3D asks for: a vertex moves by at most 1/512 pixel; 32-bit edge functions
/// up to about 180 pixels, 64-bit ones above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sub8 {}

impl Subpixel for Sub4 {
    const BITS: u32 = 4;
}

impl Subpixel for Sub8 {
    const BITS: u32 = 8;
}

/// How far a snapped coordinate may lie from the frame's origin, in pixels.
pub const GUARD_PIXELS: i32 = 1 << 15;

// An edge function is twice the area of a triangle of two vertices and a sample, all within the guard band and
// thus in a square of side 2 * GUARD_PIXELS: it is at most side^2, and so is each of its products. This is the
// proof that i64 never overflows, and that an edge function is also exact in f64 (2^53).
const _: () = assert!((2 * GUARD_PIXELS as i128 * Sub8::ONE as i128).pow(2) <= 1 << 53);
const _: () = assert!((2 * GUARD_PIXELS as i128 * Sub4::ONE as i128).pow(2) <= 1 << 53);
// A coordinate and a sample one pixel outside fit i32 with room to spare.
const _: () = assert!((GUARD_PIXELS as i64 + 1) * (Sub8::ONE as i64) < i32::MAX as i64 / 4);

/// A screen coordinate in units of 2^-BITS pixel.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed<S> {
    subpixels: i32,
    precision: PhantomData<S>,
}

impl<S: Subpixel> Fixed<S> {
    /// The frame's origin.
    pub const ZERO: Self = Self { subpixels: 0, precision: PhantomData };

    /// The outermost coordinate, `GUARD_PIXELS` from the origin.
    pub const GUARD: i32 = GUARD_PIXELS << S::BITS;

    /// The coordinate at `subpixels` units of 2^-BITS pixel; `None` beyond the guard band.
    #[must_use]
    #[inline]
    pub const fn from_subpixels(subpixels: i32) -> Option<Self> {
        if subpixels < -Self::GUARD || subpixels > Self::GUARD {
            return None;
        }
        Some(Self { subpixels, precision: PhantomData })
    }

    /// Snaps `center + offset` pixels: `offset` is rounded to the nearest subpixel, halves upwards, and `center`,
    /// given in half pixels, is added exactly. `None` beyond the guard band, or for a NaN.
    ///
    /// Rounding the offset alone makes the result independent of where a viewport lies on the target.
    ///
    /// # Precision
    /// The scaling by 2^BITS is exact and the rounding is correct: the result is within 2^-(BITS+1) pixel of
    /// `center + offset`.
    #[must_use]
    #[inline]
    pub fn snap(center_in_half_pixels: i32, offset: f32) -> Option<Self> {
        #[expect(clippy::cast_precision_loss, reason = "a power of two")]
        let scaled = offset * S::ONE as f32;
        if scaled.is_nan() {
            return None;
        }
        let center = center_in_half_pixels.checked_mul(S::HALF)?;
        Self::from_subpixels(round_half_up(scaled).checked_add(center)?)
    }

    /// The coordinate in units of 2^-BITS pixel.
    #[must_use]
    #[inline]
    pub const fn subpixels(self) -> i32 {
        self.subpixels
    }
}

impl<S> fmt::Debug for Fixed<S>
where
    S: Subpixel,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.subpixels, S::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapping_rounds_halves_upwards_around_any_centre() {
        let at = |center, offset| Fixed::<Sub4>::snap(center, offset).map(Fixed::subpixels);
        assert_eq!(at(0, 1.0 / 32.0), Some(1));
        assert_eq!(at(0, -1.0 / 32.0), Some(0));
        assert_eq!(at(0, -1.5 / 16.0), Some(-1));
        assert_eq!(at(641, 2.0), Some(641 * 8 + 32));
        assert_eq!(at(-641, 1.0 / 32.0), Some(-641 * 8 + 1));
    }

    #[test]
    fn the_guard_band_is_closed_and_nothing_lies_beyond() {
        assert_eq!(Fixed::<Sub8>::snap(0, 32768.0).map(Fixed::subpixels), Some(1 << 23));
        assert_eq!(Fixed::<Sub8>::snap(0, -32768.0).map(Fixed::subpixels), Some(-(1 << 23)));
        for outside in [32768.01, -32768.01, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(Fixed::<Sub8>::snap(0, outside), None, "{outside}");
        }
        assert_eq!(Fixed::<Sub8>::snap(i32::MAX, 0.0), None);
        assert_eq!(Fixed::<Sub8>::from_subpixels((1 << 23) + 1), None);
    }
}
