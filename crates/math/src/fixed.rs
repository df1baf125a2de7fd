//! Fixed-point screen coordinates, and the bound that keeps the edge functions built on them exact.

use crate::round::{floor_i32, round_half_up};

/// The number of fraction bits of snapped coordinates.
///
/// More bits follow a slowly moving vertex more smoothly: snapping moves a vertex by at most 2^-(bits+1) pixels. Fewer
/// bits let larger triangles stay in 32-bit edge functions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
pub enum Subpixel {
    /// Four bits (28.4): a vertex moves by at most 1/32 pixel; 32-bit edge functions up to about 2,890 pixels.
    Sub4 = 4,
    /// Eight bits (24.8), the number that Direct3D asks for: a vertex moves by at most 1/512 pixel; 32-bit edge
    /// functions up to about 180 pixels, 64-bit ones above.
    #[default]
    Sub8 = GREATEST_BITS,
}

pub use Subpixel::{Sub4, Sub8};

impl Subpixel {
    /// The number.
    #[must_use]
    #[inline(always)]
    pub const fn bits(self) -> u32 {
        self as u32
    }
}

/// Fraction bits of the finest grid.
const GREATEST_BITS: u32 = 8;

/// The greatest distance of a snapped coordinate from the frame's origin, in pixels.
pub const GUARD_PIXELS: i32 = 1 << 15;

// An edge function is twice the area of a triangle of two vertices and a sample, all within the guard band and
// thus in a square of side 2 * GUARD_PIXELS: it is at most side^2, and so is each of its products. This is the
// proof that i64 never overflows, and that an edge function is also exact in f64 (2^53).
const _: () = assert!((2 * Fixed::LIMIT as i128).pow(2) <= 1 << 53);
// A coordinate and a sample one pixel outside fit i32 with room to spare.
const _: () = assert!((GUARD_PIXELS as i64 + 1) * (1 << GREATEST_BITS) < i32::MAX as i64 / 4);

/// A screen coordinate: the subpixel that it is snapped to, and how far from it the place lies that was snapped. How
/// many subpixels there are to a pixel, a [`Subpixel`] says, which is not stored.
///
/// ```text
///   bits = 256 subpixels + 128 + moved     -128 <= moved <= 127, in 256ths of a subpixel
/// ```
///
/// So the shift of the word that gives the subpixel rounds to the nearest one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable, bytemuck::TransparentWrapper))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Fixed(i32);

/// Half of a subpixel, in its parts.
const HALF: i32 = 1 << (Fixed::PARTS - 1);

impl Fixed {
    /// Bits of a subpixel's parts.
    pub const PARTS: u32 = 8;

    /// The frame's origin.
    pub const ZERO: Self = Self(HALF);

    /// One more than the greatest coordinate in subpixels, and the distance of the least from the origin: the guard
    /// band in the finest grid.
    pub const LIMIT: i32 = GUARD_PIXELS << GREATEST_BITS;

    /// The coordinate of so many subpixels; `None` below -[`LIMIT`](Self::LIMIT) and from `LIMIT` on.
    #[must_use]
    #[inline]
    pub const fn from_subpixels(subpixels: i32) -> Option<Self> {
        if subpixels < -Self::LIMIT || subpixels >= Self::LIMIT {
            None
        } else {
            Some(Self::wrapping(subpixels))
        }
    }

    /// The coordinate of so many subpixels, which from [`LIMIT`](Self::LIMIT) on wrap to -`LIMIT`.
    ///
    /// # Cost
    /// Two instructions, where [`from_subpixels`](Self::from_subpixels) has two comparisons more.
    #[must_use]
    #[inline(always)]
    pub const fn wrapping(subpixels: i32) -> Self {
        Self(subpixels << Self::PARTS | HALF)
    }

    /// `center + offset` pixels, snapped: `offset` is rounded to the nearest subpixel, halves upwards, and `center`,
    /// given in half pixels, is added exactly. `None` beyond the guard band, or for a NaN.
    ///
    /// Rounding the offset alone makes the result independent of where a viewport lies on the target.
    ///
    /// # Precision
    /// The scaling by 2^bits is exact and the rounding is correct: the subpixel is within 2^-(bits+1) pixel of
    /// `center + offset`. With [`moved`](Self::moved) added it is at most 2^-(bits+8) pixel less.
    #[must_use]
    #[inline]
    pub fn snap(subpixel: Subpixel, center_in_half_pixels: i32, offset: f32) -> Option<Self> {
        let bits = subpixel.bits();
        #[expect(clippy::cast_precision_loss, reason = "a power of two")]
        let scaled = offset * (1 << bits) as f32;
        if scaled.is_nan() {
            return None;
        }
        let center = center_in_half_pixels.checked_mul(1 << (bits - 1))?;
        let subpixels = round_half_up(scaled).checked_add(center)?;
        let guard = GUARD_PIXELS << bits;
        if subpixels < -guard || subpixels >= guard {
            return None;
        }
        // Exact: what rounding leaves is a multiple of the number's last bit.
        #[expect(clippy::cast_precision_loss, reason = "the number itself, or its integer neighbour")]
        let moved = floor_i32((scaled - (subpixels - center) as f32) * (1 << Self::PARTS) as f32);
        Some(Self((subpixels << Self::PARTS | HALF) + moved))
    }

    /// The coordinate with these bits.
    #[must_use]
    #[inline(always)]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits.cast_signed())
    }

    /// Its bits.
    #[must_use]
    #[inline(always)]
    pub const fn to_bits(self) -> u32 {
        self.0.cast_unsigned()
    }

    /// The nearest subpixel's number, counted from the origin.
    #[must_use]
    #[inline(always)]
    pub const fn subpixels(self) -> i32 {
        self.0 >> Self::PARTS
    }

    /// The distance from that subpixel to the place that was snapped to it, in 256ths of a subpixel: -128 to 127. It is
    /// rounded down.
    #[must_use]
    #[inline(always)]
    pub const fn moved(self) -> i32 {
        (self.0 & (2 * HALF - 1)) - HALF
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapping_rounds_halves_upwards_around_any_centre() {
        let at = |center, offset| Fixed::snap(Sub4, center, offset).map(Fixed::subpixels);
        assert_eq!(at(0, 1.0 / 32.0), Some(1));
        assert_eq!(at(0, -1.0 / 32.0), Some(0));
        assert_eq!(at(0, -1.5 / 16.0), Some(-1));
        assert_eq!(at(641, 2.0), Some(641 * 8 + 32));
        assert_eq!(at(-641, 1.0 / 32.0), Some(-641 * 8 + 1));
    }

    #[test]
    fn the_way_from_the_subpixel_is_kept() {
        // Halves of subpixels, in 256ths and a little less, around centres between pixels and on them.
        for (subpixel, center, half_parts) in
            (-3000..3000).flat_map(|k| [(Sub4, 7, k), (Sub8, -12, k), (Sub8, 99_999 / 2, 3 * k + 1)])
        {
            let place = f64::from(half_parts) / 512.0;
            #[expect(clippy::cast_possible_truncation, reason = "exact")]
            let offset = (place / f64::from(1 << subpixel.bits())) as f32;
            let found = Fixed::snap(subpixel, center, offset).expect("within the guard band");
            let moved = f64::from(found.moved()) / 256.0;
            let from_center = f64::from(found.subpixels() - (center << (subpixel.bits() - 1)));
            assert_eq!(from_center, (place + 0.5).floor());
            assert_eq!((from_center + moved) * 256.0, (place * 256.0).floor());
        }
        assert_eq!(Fixed::ZERO.moved() | Fixed::wrapping(-77).moved(), 0);
    }

    #[test]
    fn the_guard_band_is_half_open_and_nothing_lies_beyond() {
        assert_eq!(Fixed::snap(Sub8, 0, 32767.996).map(Fixed::subpixels), Some((1 << 23) - 1));
        assert_eq!(Fixed::snap(Sub8, 0, -32768.0).map(Fixed::subpixels), Some(-(1 << 23)));
        for outside in [32768.0, -32768.01, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(Fixed::snap(Sub8, 0, outside), None, "{outside}");
        }
        assert_eq!(Fixed::snap(Sub8, i32::MAX, 0.0), None);
        assert_eq!(Fixed::from_subpixels(1 << 23), None);
        for (given, wrapped) in [(5, 5), (-5, -5), (1 << 23, -1 << 23), (-1 << 23, -1 << 23), (1 << 24, 0)] {
            assert_eq!(Fixed::wrapping(given).subpixels(), wrapped);
        }
    }
}
