//! Reciprocals without a division: a table and Newton's steps.

use crate::{high, high_signed};

/// The starting values of the steps: 2^17/x for the middle of each 256th of [1, 2), to the nearest, without the highest
/// bit, which all have.
static TABLE: [u16; 256] = {
    let mut table = [0; 256];
    let (mut k, mut middle) = (0, (1 << 9) + 1);
    while k < 256 {
        #[expect(clippy::cast_possible_truncation, reason = "from 0 to 2^16 - 1")]
        let entry = ((((1u32 << 26) + middle / 2) / middle) - (1 << 16)) as u16;
        table[k] = entry;
        k += 1;
        middle += 2;
    }
    table
};

/// 2^63 / x for x from 2^31 to 2^32 - 1, at most 2^32 - 1, after so many of Newton's steps.
///
/// # Precision
/// Never too large. Relative to the exact quotient it falls short by less than 2^-17 after one step, and 2^-29 after
/// two.
///
/// # Cost
/// A load from a table of 512 bytes, and two products of 32 bits to 64 for each step.
#[must_use]
#[inline]
pub fn reciprocal<const STEPS: u32>(x: u32) -> u32 {
    let entry = TABLE.get((x >> 23 & 255) as usize).copied().unwrap_or(0);
    let mut y = (u32::from(entry) | 1 << 16) << 15;
    for _ in 0..STEPS {
        // y (2 - x y), with x in [1, 2) in units of 2^-31 and y in (1/2, 1] in 2^-32. The complement is one unit below
        // the difference, for what the product's last bits were.
        let more = high(x, y) ^ i32::MAX as u32;
        // That minus 1, in units of 2^-32; of a negative one `high` has y too much.
        let part = high(y, more << 1);
        y = if more.cast_signed() < 0 { part } else { y.saturating_add(part) };
    }
    y
}

/// 2^61 / x for x from 2^30 to 2^31 - 1, below 2^31.
///
/// # Precision
/// Never too large, and short of it by less than 2^-28, relatively.
///
/// # Cost
/// A load from a table of 512 bytes, two products of 32 bits to 64, and two small ones: half of
/// [`reciprocal::<2>`](reciprocal) where products are dear.
#[must_use]
#[inline(always)]
pub fn reciprocal_signed(x: i32) -> i32 {
    let entry = TABLE.get((x >> 22 & 255).cast_unsigned() as usize).copied().unwrap_or(0);
    // 17 bits of y, which is in 2^-31.
    let first = i32::from(entry) | 1 << 16;
    // y (2 - x y), with x in [1, 2) and y in (1/2, 1]. What is left of 1, in 2^-29 and a unit short, is small; so
    // factors need no more bits than count.
    let left = |y: i32| (1 << 29) - 1 - high_signed(x, y);
    let y = (first << 14) + ((first * (left(first << 14) >> 6)) >> 9);
    y + (((y >> 15) * left(y)) >> 14)
}

/// 2^32 / x for x from 2^15 to 2^16 - 1, below 2^17.
///
/// # Precision
/// Never too large, and short of it by less than 2^-15, relatively.
///
/// # Cost
/// A load from a table of 512 bytes, and two small products.
#[must_use]
#[inline(always)]
pub fn reciprocal_of_half(x: u32) -> u32 {
    let entry = TABLE.get((x >> 7 & 255) as usize).copied().unwrap_or(0);
    let y = i32::from(entry) | 1 << 16;
    // Of x y what is left to 2^32, less one, as a word does not hold that.
    let left = !x.cast_signed().wrapping_mul(y);
    (y + ((y * (left >> 10)) >> 22)).cast_unsigned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::println;

    fn worst<const STEPS: u32>() -> f64 {
        let mut worst = 0.0;
        for x in (1u32 << 31..=u32::MAX).step_by(4001).chain([1 << 31, (1 << 31) + 1, u32::MAX]) {
            let y = u64::from(reciprocal::<STEPS>(x));
            let exact = (1u64 << 63) / u64::from(x);
            assert!(y <= exact, "{x}: {y} exceeds {exact}");
            worst = f64::max(
                worst,
                1.0 - f64::from(x) * f64::from(u32::try_from(y).expect("clamped")) / 2f64.powi(63),
            );
        }
        worst
    }

    #[test]
    fn reciprocals_of_half_words_keep_their_bound_and_never_exceed() {
        let mut worst = 0.0;
        for x in 1 << 15..1 << 16 {
            let y = reciprocal_of_half(x);
            let short = 1.0 - f64::from(x) * f64::from(y) / 2f64.powi(32);
            assert!(y < 1 << 17 && short >= 0.0, "{x}: {y}");
            worst = f64::max(worst, short);
        }
        println!("2^{:.2}", worst.log2());
        assert!(worst < 2f64.powi(-15) && worst > 2f64.powi(-17));
    }

    #[test]
    fn signed_reciprocals_keep_their_bounds_and_never_exceed() {
        let mut worst = 0.0;
        let ends = [1 << 30, (1 << 30) + 1, i32::MAX - 1, i32::MAX];
        for x in (1 << 30..=i32::MAX).step_by(1009).chain(ends) {
            let y = reciprocal_signed(x);
            let short = 1.0 - f64::from(x) * f64::from(y) / 2f64.powi(61);
            assert!(y > 0 && short >= 0.0, "{x}: {y}");
            worst = f64::max(worst, short);
        }
        println!("2^{:.2}", worst.log2());
        assert!(worst < 2f64.powi(-28) && worst > 2f64.powi(-30));
    }

    #[test]
    fn reciprocals_keep_their_bounds_and_never_exceed() {
        let [one, two] = [worst::<1>(), worst::<2>()];
        println!("one step 2^{:.2}, two steps 2^{:.2}", one.log2(), two.log2());
        assert!(one < 2f64.powi(-17) && two < 2f64.powi(-29));
        assert!(one > 2f64.powi(-19), "the bound is not tested");
    }
}
