//! The shape of a small triangle: where its edges cross the rows, and the planes over it.

use super::{Coarse, Fine, Grid};
use alberti_math::{LOW_WORDS_ONLY, high_of_half, high_signed, reciprocal, reciprocal_signed};

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
pub(super) struct Shape<G> {
    grid: G,
    /// The factors of the second and the third vertex in a slope's sum, for columns and for rows.
    right: [i32; 2],
    down: [i32; 2],
    /// 2^62 over the signed area, which was shifted to the left until it had 32 bits.
    per_area: i32,
    /// The bits by which the sum is shifted to the left.
    shift: u32,
    /// The bits by which a slope is shifted to the right, in fine ones.
    less: u32,
    /// The bits of the box's sides, of which no side is longer.
    extent: u32,
    /// From the first vertex to the origin's centre, in subpixels: less than a pixel.
    origin: [i32; 2],
}

impl<G: Grid> Shape<G> {
    #[inline(always)]
    pub(super) fn new(
        grid: G,
        [a, b, c]: [[i32; 2]; 3],
        origin: [i32; 2],
        area: u32,
        clockwise: bool,
        extent: u32,
    ) -> Self {
        let normalizing = area.leading_zeros();
        let area = area << normalizing;
        // The area of a coarse one has 18 bits.
        let per_area =
            if grid.is_fine() { reciprocal_signed((area >> 1).cast_signed()) } else { reciprocal_18(area) };
        let normalizing = normalizing + grid.bits();
        Self {
            grid,
            right: [c[1] - a[1], a[1] - b[1]],
            down: [a[0] - c[0], b[0] - a[0]],
            per_area: if clockwise { per_area } else { -per_area },
            shift: normalizing.saturating_sub(SLOPE + 6),
            less: if grid.is_fine() { (SLOPE + 6).saturating_sub(normalizing) } else { 0 },
            extent,
            origin: [origin[0] - a[0], origin[1] - a[1]],
        }
    }

    /// Whether the slopes of a number are in range, of which `differences`, below 2^21, has the bits that those of the
    /// second and the third vertex to the first have.
    #[inline(always)]
    pub(super) fn holds(&self, differences: u32) -> bool {
        // The sum of two products must be less than 2^31 after the shift. Sides of fine ones have up to 13 bits, so
        // that fewer of the differences' are counted.
        let (most, unused) = (self.extent + 1, if self.grid.is_fine() { 4 } else { 0 });
        ((differences >> unused) + 1).wrapping_mul(most) < (1 << (30 - unused)) >> self.shift
    }

    /// The slope in units of 2^-SLOPE a pixel.
    #[inline(always)]
    fn slope(&self, [b, c]: [i32; 2], [by_b, by_c]: [i32; 2]) -> i32 {
        let along = b.wrapping_mul(by_b).wrapping_add(c.wrapping_mul(by_c));
        high_signed(along << self.shift, self.per_area) >> self.less
    }

    /// The plane through the first vertex's `at`, in units that are `bits` finer than the differences of the other two.
    #[inline(always)]
    pub(super) fn ramp(&self, at: i32, more: [i32; 2], bits: u32) -> Ramp {
        let across = self.slope(more, self.right) >> (SLOPE - bits);
        let down = self.slope(more, self.down) >> (SLOPE - bits);
        let part = |slope: i32, origin: i32| {
            if self.grid.is_fine() {
                (slope >> 8) * origin + (((slope & 255) * origin) >> 8)
            } else {
                (slope >> 4) * origin
            }
        };
        let at = at.wrapping_add(part(across, self.origin[0])).wrapping_add(part(down, self.origin[1]));
        Ramp { at, across, down }
    }
}

/// 2^62 / x, for x of 18 bits, shifted to the left until it has 32.
///
/// # Precision
/// Within 2^-28, relatively: the table's 2^-9 become 2^-17 and 2^-34, and the product is cut at 2^-29.
#[inline(always)]
fn reciprocal_18(x: u32) -> i32 {
    let first = (reciprocal::<0>(x) >> 1).cast_signed();
    let (upper, lower) = ((x >> 16) as u16, (x >> 14) & 3);
    // y (2 - x y), with x in [1, 2) in units of 2^-31 and y in (1/2, 1] in 2^-31. The difference from 1 is small, and
    // so are factors with as many bits as count. Of x the first time 16 bits do.
    let left = |y: i32, lower: u32| {
        let y = y.cast_unsigned();
        (1 << 30) - (high_of_half(upper, y) + ((lower * (y >> 16)) >> 2)).cast_signed()
    };
    let y = first + (((first >> 14) * (left(first, 0) >> 8)) >> 8);
    y + (((y >> 15) * left(y, lower)) >> 15)
}

/// `x`, or of a negative number the complement: it has no bit from the k-th on if the number is in -2^k..2^k.
#[inline(always)]
pub(super) fn magnitude(x: i32) -> u32 {
    (x ^ (x >> 31)).cast_unsigned()
}

/// Bits of the fraction of a fine crossing.
const FINE_COLUMN: u32 = 25;

/// Bits of a crossing's fraction.
#[inline(always)]
fn column(grid: impl Grid) -> u32 {
    if grid.is_fine() { FINE_COLUMN } else { 21 }
}

/// The first column whose centre is not to the left of an edge, in a row: the highest bits of `at`, from those of
/// [`column`] on.
#[derive(Clone, Copy)]
pub(super) struct Crossing<G> {
    grid: G,
    at: i32,
    step: i32,
}

impl<G: Grid> Crossing<G> {
    /// The edge down from `p` to `q`, in the row of a sample that is at a height between. Columns count from that
    /// sample's. The edge is less than 2^9 subpixels high, a fine one 2^12.
    #[inline(always)]
    pub(super) fn new(grid: G, p: [i32; 2], q: [i32; 2], [x, y]: [i32; 2]) -> Self {
        let [dx, dy] = [q[0] - p[0], (q[1] - p[1]).max(1)];
        let column = column(grid);
        let from = ((p[0] - x) << (column - grid.bits())) + (1 << column);
        if grid.is_fine() {
            // The step is too large for edges that are less than a pixel high, which cross no other row.
            let step = fine_quotient(dx << Fine.bits(), dy);
            Self { grid, at: from - 1 + fine_quotient(dx * (y - p[1]), dy), step }
        } else {
            let step = if LOW_WORDS_ONLY { quotient(dx, dy) } else { (dx << column) / dy };
            Self { grid, at: from - (1 << 7) + (step.wrapping_mul(y - p[1]) >> Coarse.bits()), step }
        }
    }

    /// The column.
    #[inline(always)]
    pub(super) fn column(self) -> i32 {
        self.at >> column(self.grid)
    }

    /// Goes down one row.
    #[inline(always)]
    pub(super) fn next_row(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }
}

/// The quotient of fine subpixels in 2^-25 of a pixel, rounded down, if it is within 2^13 of 0.
#[inline(always)]
fn fine_quotient(n: i32, d: i32) -> i32 {
    const MOST: i32 = 1 << 13;
    const FRACTION: u32 = FINE_COLUMN - 8;
    let (n, d) = (n.wrapping_add(d << 13).cast_unsigned(), d.cast_unsigned());
    let (whole, rest) = (n / d, ((n % d) << FRACTION) / d);
    (whole.cast_signed().wrapping_sub(MOST) << FRACTION).wrapping_add(rest.cast_signed())
}

/// 2^16 / d, rounded down.
static PER_HEIGHT: [u16; 512] = {
    let mut table = [u16::MAX; 512];
    let mut d = 2;
    while d < table.len() {
        #[expect(clippy::cast_possible_truncation, reason = "from 2 on")]
        let entry = ((1 << 16) / d) as u16;
        table[d] = entry;
        d += 1;
    }
    table
};

/// 2^21 dx / dy for |dx| and dy up to 2^9, within two units: without a division.
#[inline(always)]
fn quotient(dx: i32, dy: i32) -> i32 {
    let per_height = i32::from(PER_HEIGHT.get(dy.cast_unsigned() as usize).copied().unwrap_or(0));
    let mut quotient = (dx * per_height) << 5;
    // The table is within dy 2^-16, relatively, and each time what is left is as much smaller.
    for _ in 0..2 {
        let left = (dx << 21) - quotient * dy;
        quotient += (left * per_height) >> 16;
    }
    quotient
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::println;

    /// The greatest differences of either sign, also those of which the magnitude is one less.
    fn none_overflow(grid: impl Grid, corners: &[[[i32; 2]; 2]]) {
        let mut held = 0;
        for &[b, c] in corners {
            let area = (b[0] * c[1] - b[1] * c[0]).unsigned_abs();
            let extent = magnitude(b[0]) | magnitude(b[1]) | magnitude(c[0]) | magnitude(c[1]);
            let shape = Shape::new(grid, [[0; 2], b, c], [0; 2], area, true, extent);
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
    fn slopes_that_hold_do_not_overflow() {
        none_overflow(
            Coarse,
            &[
                [[-64, 3], [64, 4]],
                [[-255, 0], [0, 255]],
                [[16, 1], [0, 16]],
                [[1, 255], [-1, 255]],
                [[-511, 0], [0, 511]],
                [[1, 511], [-1, 511]],
            ],
        );
        none_overflow(
            Fine,
            &[
                [[-64, 3], [64, 4]],
                [[-4095, 0], [0, 4095]],
                [[-8191, 0], [0, 8191]],
                [[1, 8191], [-1, 8191]],
                [[200, 900], [1000, 300]],
            ],
        );
    }

    #[test]
    fn quotients_without_division_are_within_two_units() {
        for dx in -512..512 {
            for dy in 1..512 {
                let exact = f64::from(dx << 21) / f64::from(dy);
                assert!((f64::from(quotient(dx, dy)) - exact).abs() <= 2.0, "{dx} / {dy}");
            }
        }
    }

    #[test]
    fn fine_quotients_are_rounded_down() {
        for dy in (1..300).chain((300..1 << 13).step_by(7)) {
            for n in (0..800).map(|k| k * (20 * dy + 1) - 8000 * dy).chain([-8192 * dy, 8191 * dy]) {
                let exact = (i64::from(n) << 17).div_euclid(i64::from(dy));
                assert_eq!(i64::from(fine_quotient(n, dy)), exact, "{n} / {dy}");
            }
        }
    }

    /// All that there are.
    #[test]
    fn reciprocals_of_areas_keep_their_bound() {
        let mut worst = 0.0;
        for x in (1 << 17..1 << 18u32).map(|area| area << 14) {
            let y = reciprocal_18(x);
            assert!(y > 0, "{x}: {y}");
            worst = f64::max(worst, (f64::from(x) * f64::from(y) / 2f64.powi(62) - 1.0).abs());
        }
        println!("2^{:.2}", worst.log2());
        assert!(worst <= 2f64.powi(-28) && worst > 2f64.powi(-32));
    }
}
