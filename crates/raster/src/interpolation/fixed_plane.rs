//! Functions that are linear on the screen, in integers: their values from the edge functions, and their slopes.

use crate::edge::EdgeInt;
use crate::interpolation::Oriented;
use alberti_math::{Varying, reciprocal};

/// Bits of the fraction of weights.
const WEIGHT: u32 = 30;

/// A function that is linear on the screen: its excess at the second and the third vertex over the first, and its slope
/// by column.
#[derive(Clone, Copy)]
pub(crate) struct FixedPlane {
    pub(crate) more: [i32; 2],
    pub(crate) slope: i32,
}

impl FixedPlane {
    /// The excess over the first vertex where the others have these weights, to the nearest. Weights are never too
    /// large, together not above 1, and so it is within the range of the three.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "not greater than the differences")]
    pub(crate) fn at(&self, [b, c]: [i32; 2]) -> i32 {
        let sum = i64::from(self.more[0]) * i64::from(b) + i64::from(self.more[1]) * i64::from(c);
        // Weights are negative.
        (((sum + (1 << (WEIGHT - 1))) >> WEIGHT) as i32).wrapping_neg()
    }
}

/// The shape of a triangle.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    area: Area,
    /// The increments of the edge functions of the second and the third vertex for a step of one subpixel to the right.
    across: [i32; 2],
    /// Bits of the subpixels.
    bits: u32,
}

impl Shape {
    #[inline(always)]
    pub(crate) fn new<V: Varying>(triangle: &Oriented<'_, V>, area: Area) -> Self {
        let [a, b, c] = triangle.corners;
        Self { area, across: [c[1] - a[1], a[1] - b[1]], bits: triangle.bits }
    }

    /// The plane through three numbers that differ by less than 2^31.
    #[inline(always)]
    pub(crate) fn plane(&self, [a, b, c]: [i32; 3]) -> FixedPlane {
        let more = [b - a, c - a];
        let along =
            i64::from(more[0]) * i64::from(self.across[0]) + i64::from(more[1]) * i64::from(self.across[1]);
        FixedPlane { more, slope: self.slope(along) }
    }

    /// The slope by column; `more` over the area is that by subpixel. Towards 0, within the range of `i32`.
    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the highest 32 bits of 64, and what was found to fit"
    )]
    fn slope(&self, more: i64) -> i32 {
        let Self { area, bits, .. } = self;
        let normalizing = more.unsigned_abs().leading_zeros() & 63;
        let high = ((more.unsigned_abs() << normalizing) >> 32) as u32;
        let product = u64::from(high) * u64::from(area.quotient);
        let shift = (31 + normalizing + area.dropped).saturating_sub(bits + area.normalizing);
        let magnitude = if shift < 64 { (product >> shift).min(i32::MAX as u64) as i32 } else { 0 };
        if more < 0 { -magnitude } else { magnitude }
    }

    /// The weights of the second and the third vertex at a sample with these edge functions.
    #[inline(always)]
    pub(crate) fn weights<I: EdgeInt>(&self, [_, b, c]: [I; 3]) -> [i32; 2] {
        let weight = |e: I| {
            let part = u64::from(e.without_last(self.area.dropped) << self.area.normalizing);
            // Compilers see that this is negative, and then have the one instruction that multiplies signed numbers.
            -(((part * u64::from(self.area.quotient)) >> (63 - WEIGHT)) as i32)
        };
        [weight(b), weight(c)]
    }
}

/// One over twice the area.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    /// The number of last bits without which edge functions are below 2^32.
    pub(crate) dropped: u32,
    /// The number of bits that bring the area without those to 2^31 or more; `quotient` is 2^63 over that.
    pub(crate) normalizing: u32,
    pub(crate) quotient: u32,
}

impl Area {
    /// Not inlined: compilers would find it before the first row, where there may be none.
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and below 2^32")]
    pub(crate) fn new(doubled: i64) -> Self {
        let dropped = (64 - doubled.leading_zeros()).saturating_sub(32);
        let word = (doubled >> dropped) as u32;
        let normalizing = word.leading_zeros();
        Self { dropped, normalizing, quotient: reciprocal::<2>(word << normalizing) }
    }
}
