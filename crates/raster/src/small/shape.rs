//! The shape of a small triangle: where its edges cross the rows, and the planes over it.

use super::{BITS, ONE};
use alberti_math::{high, high_signed, reciprocal};

/// Bits of a crossing's fraction.
const COLUMN: u32 = 20;
/// Bits of a slope's fraction, beyond those of the number.
pub(super) const SLOPE: u32 = 12;

/// A number that is linear on the screen: its value at the first sample of the box, and the increments for a column and
/// for a row.
#[derive(Clone, Copy)]
pub(super) struct Ramp {
    pub(super) at: i32,
    pub(super) across: i32,
    pub(super) down: i32,
}

impl Ramp {
    /// The value at a sample.
    #[inline(always)]
    pub(super) fn at(self, [column, row]: [i32; 2]) -> i32 {
        self.at.wrapping_add(self.across.wrapping_mul(column)).wrapping_add(self.down.wrapping_mul(row))
    }
}

/// The numbers that all slopes have in common.
pub(super) struct Shape {
    /// The factors of the second and the third vertex in a slope's sum, for columns and for rows.
    right: [i32; 2],
    down: [i32; 2],
    /// 2^62 over the signed area, which was shifted to the left by `shift` + 14.
    per_area: i32,
    shift: u32,
    /// From the first vertex to the centre of the first sample, in subpixels.
    origin: [i32; 2],
}

impl Shape {
    #[inline(always)]
    pub(super) fn new([a, b, c]: [[i32; 2]; 3], first_sample: [i32; 2], area: u32, clockwise: bool) -> Self {
        let normalizing = area.leading_zeros();
        let per_area = reciprocal_31(area << normalizing).cast_signed();
        Self {
            right: [c[1] - a[1], a[1] - b[1]],
            down: [a[0] - c[0], b[0] - a[0]],
            per_area: if clockwise { per_area } else { -per_area },
            shift: normalizing.saturating_sub(14),
            origin: [first_sample[0] - a[0], first_sample[1] - a[1]],
        }
    }

    /// Whether the slopes of a number are in range, of which `differences` has the bits that those of the second and
    /// the third vertex to the first have.
    #[inline(always)]
    pub(super) fn holds(&self, differences: u32) -> bool {
        let [right, down] = [self.right, self.down].map(|[b, c]| b.unsigned_abs() | c.unsigned_abs());
        // The bits of a product, of the sum of two, and the sign's.
        let bits = 64 - (right | down).leading_zeros() - differences.leading_zeros() + 2;
        bits + self.shift <= 32
    }

    /// The slope in units of 2^-SLOPE a pixel.
    #[inline(always)]
    fn slope(&self, [b, c]: [i32; 2], [by_b, by_c]: [i32; 2]) -> i32 {
        let along = b.wrapping_mul(by_b).wrapping_add(c.wrapping_mul(by_c));
        high_signed(along << self.shift, self.per_area)
    }

    /// The plane through the first vertex's `at`, in units that are `bits` finer than the differences of the other two.
    #[inline(always)]
    pub(super) fn ramp(&self, at: i32, more: [i32; 2], bits: u32) -> Ramp {
        let across = self.slope(more, self.right) >> (SLOPE - bits);
        let down = self.slope(more, self.down) >> (SLOPE - bits);
        let [x, y] = self.origin;
        // Whole pixels wrap as often as they like: at samples inside the sum is small.
        let whole = Ramp { at, across, down }.at([x >> BITS, y >> BITS]);
        let part = Ramp { at: 0, across: across >> BITS, down: down >> BITS };
        Ramp { at: whole.wrapping_add(part.at([x & (ONE - 1), y & (ONE - 1)])), across, down }
    }
}

/// 2^62 / x, for x from 2^31 on.
///
/// # Precision
/// Within 2^-28, relatively: the table's 2^-9 become 2^-17 and 2^-34, and the second product is rounded to 2^-28. For
/// the areas of small triangles below 2^31.
#[inline(always)]
fn reciprocal_31(x: u32) -> u32 {
    let mut y = reciprocal::<0>(x) >> 1;
    for _ in 0..2 {
        // y (2 - x y), with x in [1, 2) and y in (1/2, 1], in units of 2^-31; the product in 2^-30.
        y = high(y, (1 << 31) - high(x, y)) << 2;
    }
    y
}

/// `x`, or of a negative number the complement: it has no bit from the k-th on if the number is in -2^k..2^k.
#[inline(always)]
pub(super) fn magnitude(x: i32) -> u32 {
    (x ^ (x >> 31)).cast_unsigned()
}

/// The first column whose centre is not to the left of an edge, in a row: the highest bits of `at`, from COLUMN on.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    at: i32,
    step: i32,
}

impl Crossing {
    /// The edge down from `p` to `q`, which is below, at most 2^8 subpixels, in the row of a sample that is at a height
    /// between. Columns count from that sample's.
    #[inline(always)]
    pub(super) fn new(p: [i32; 2], q: [i32; 2], [x, y]: [i32; 2]) -> Self {
        let step = ((q[0] - p[0]) << COLUMN) / (q[1] - p[1]).max(1);
        let from = ((p[0] - x) << (COLUMN - BITS)) + ((1 << COLUMN) - (1 << 7));
        Self { at: from + (step.wrapping_mul(y - p[1]) >> BITS), step }
    }

    /// The column.
    #[inline(always)]
    pub(super) fn column(self) -> i32 {
        self.at >> COLUMN
    }

    /// Goes down one row.
    #[inline(always)]
    pub(super) fn next_row(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::println;

    /// All that there are.
    #[test]
    fn reciprocals_of_areas_keep_their_bound() {
        let mut worst = 0.0;
        for area in 1..=1u32 << 16 {
            let x = area << area.leading_zeros();
            let y = reciprocal_31(x);
            assert!(y < 1 << 31, "{area}: {y}");
            worst = f64::max(worst, (f64::from(x) * f64::from(y) / 2f64.powi(62) - 1.0).abs());
        }
        println!("2^{:.2}", worst.log2());
        assert!(worst <= 2f64.powi(-28) && worst > 2f64.powi(-32));
    }
}
