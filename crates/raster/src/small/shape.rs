//! The shape of a small triangle: where its edges cross the rows, and the planes over it.

use super::BITS;
use alberti_math::{LOW_WORDS_ONLY, high_of_half, high_signed, reciprocal};

/// Bits of a crossing's fraction.
const COLUMN: u32 = 20;
/// Bits of a slope's fraction, beyond those of the number.
pub(super) const SLOPE: u32 = 12;

/// A number that is linear on the screen: its value at the origin, and the increments for a column and for a row.
#[derive(Clone, Copy)]
pub(super) struct Ramp {
    pub(super) at: i32,
    pub(super) across: i32,
    pub(super) down: i32,
}

impl Ramp {
    /// The value so many columns and rows from the origin.
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
    /// The bits of the box's sides, of which no side is longer.
    extent: u32,
    /// From the first vertex to the origin's centre, in subpixels: less than a pixel.
    origin: [i32; 2],
}

impl Shape {
    #[inline(always)]
    pub(super) fn new(
        [a, b, c]: [[i32; 2]; 3],
        origin: [i32; 2],
        area: u32,
        clockwise: bool,
        extent: u32,
    ) -> Self {
        let normalizing = area.leading_zeros();
        let per_area = reciprocal_16(((area << normalizing) >> 16) as u16);
        Self {
            right: [c[1] - a[1], a[1] - b[1]],
            down: [a[0] - c[0], b[0] - a[0]],
            per_area: if clockwise { per_area } else { -per_area },
            shift: normalizing.saturating_sub(14),
            extent,
            origin: [origin[0] - a[0], origin[1] - a[1]],
        }
    }

    /// Whether the slopes of a number are in range, of which `differences`, below 2^21, has the bits that those of the
    /// second and the third vertex to the first have.
    #[inline(always)]
    pub(super) fn holds(&self, differences: u32) -> bool {
        // The sum of two products must be less than 2^31 after the shift.
        let most = self.extent + 1;
        differences.wrapping_add(1).wrapping_mul(most) < (1 << 30) >> self.shift
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
        let part = Ramp { at, across: across >> BITS, down: down >> BITS };
        Ramp { at: part.at(self.origin), across, down }
    }
}

/// 2^46 / x, for x from 2^15 on.
///
/// # Precision
/// Within 2^-28, relatively: the table's 2^-9 become 2^-17 and 2^-34, and the product is cut at 2^-29.
#[inline(always)]
fn reciprocal_16(x: u16) -> i32 {
    let first = (reciprocal::<0>(u32::from(x) << 16) >> 1).cast_signed();
    // y (2 - x y), with x in [1, 2) in units of 2^-15 and y in (1/2, 1] in 2^-31. The difference from 1 is small, and
    // so are factors with as many bits as count.
    let left = |y: i32| (1 << 30) - high_of_half(x, y.cast_unsigned()).cast_signed();
    let y = first + (((first >> 14) * (left(first) >> 8)) >> 8);
    y + (((y >> 15) * left(y)) >> 15)
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
        let [dx, dy] = [q[0] - p[0], (q[1] - p[1]).max(1)];
        let step = if LOW_WORDS_ONLY { quotient(dx, dy) } else { (dx << COLUMN) / dy };
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

/// 2^16 / d, rounded down.
static PER_HEIGHT: [u16; 257] = {
    let mut table = [u16::MAX; 257];
    let mut d = 2;
    while d < table.len() {
        #[expect(clippy::cast_possible_truncation, reason = "from 2 on")]
        let entry = ((1 << 16) / d) as u16;
        table[d] = entry;
        d += 1;
    }
    table
};

/// 2^COLUMN dx / dy for |dx| and dy up to 2^8, within two units: without a division.
#[inline(always)]
fn quotient(dx: i32, dy: i32) -> i32 {
    let per_height = i32::from(PER_HEIGHT.get(dy.cast_unsigned() as usize).copied().unwrap_or(0));
    let mut quotient = (dx * per_height) << (COLUMN - 16);
    // The table is within dy 2^-16, relatively, and each time what is left is as much smaller.
    for _ in 0..2 {
        let left = (dx << COLUMN) - quotient * dy;
        quotient += (left * per_height) >> 16;
    }
    quotient
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::println;

    /// The greatest differences of either sign, also those of which the magnitude is one less.
    #[test]
    fn slopes_that_hold_do_not_overflow() {
        let mut held = 0;
        for [b, c] in
            [[[-64_i32, 3], [64, 4]], [[-255, 0], [0, 255]], [[16, 1], [0, 16]], [[1, 255], [-1, 255]]]
        {
            let area = (b[0] * c[1] - b[1] * c[0]).unsigned_abs();
            let extent = magnitude(b[0]) | magnitude(b[1]) | magnitude(c[0]) | magnitude(c[1]);
            let shape = Shape::new([[0; 2], b, c], [0; 2], area, true, extent);
            for k in 0..21 {
                let ends = [-1 << k, (1 << k) - 1, 1 - (1 << k)];
                for (b, c) in ends.into_iter().flat_map(|b| ends.map(|c| (b, c))) {
                    let sum = |[by_b, by_c]: [i32; 2]| {
                        i64::from(b) * i64::from(by_b) + i64::from(c) * i64::from(by_c)
                    };
                    if shape.holds(magnitude(b) | magnitude(c)) {
                        for along in [shape.right, shape.down] {
                            assert!((sum(along) << shape.shift).abs() < 1 << 31, "{b} {c} along {along:?}");
                            held += 1;
                        }
                    }
                }
            }
        }
        assert!(held > 200, "{held}");
    }

    #[test]
    fn quotients_without_division_are_within_two_units() {
        for dx in -256..=256 {
            for dy in 1..=256 {
                let exact = f64::from(dx << COLUMN) / f64::from(dy);
                assert!((f64::from(quotient(dx, dy)) - exact).abs() <= 2.0, "{dx} / {dy}");
            }
        }
    }

    /// All that there are.
    #[test]
    fn reciprocals_of_areas_keep_their_bound() {
        let mut worst = 0.0;
        for x in 1 << 15..=u16::MAX {
            let y = reciprocal_16(x);
            assert!(y > 0, "{x}: {y}");
            worst = f64::max(worst, (f64::from(x) * f64::from(y) / 2f64.powi(46) - 1.0).abs());
        }
        println!("2^{:.2}", worst.log2());
        assert!(worst <= 2f64.powi(-28) && worst > 2f64.powi(-32));
    }
}
