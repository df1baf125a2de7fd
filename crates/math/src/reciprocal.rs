//! Reciprocals without a division: a table and Newton's steps.

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
#[expect(clippy::cast_possible_truncation, reason = "quotients and products are below 2^32")]
pub fn reciprocal<const STEPS: u32>(x: u32) -> u32 {
    let high = |a: u32, b: u32| (u64::from(a) * u64::from(b)) >> 31;
    let entry = TABLE.get((x >> 23 & 255) as usize).copied().unwrap_or(0);
    let mut y = (u32::from(entry) | 1 << 16) << 15;
    for _ in 0..STEPS {
        // y (2 - x y), with x in [1, 2) in units of 2^-31 and y in (1/2, 1] in 2^-32. The complement is one unit below
        // the difference, for what the product's last bits were.
        let less = (high(x, y) >> 1) as u32;
        y = high(y, !less).min(u64::from(u32::MAX)) as u32;
    }
    y
}

/// The highest 32 bits of the product of two words: a·b/2^32, rounded down.
#[must_use]
#[inline(always)]
pub const fn high(a: u32, b: u32) -> u32 {
    ((a as u64 * b as u64) >> 32) as u32
}

/// [`high`] of signed numbers.
#[must_use]
#[inline(always)]
pub const fn high_signed(a: i32, b: i32) -> i32 {
    ((a as i64 * b as i64) >> 32) as i32
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
    fn reciprocals_keep_their_bounds_and_never_exceed() {
        let [one, two] = [worst::<1>(), worst::<2>()];
        println!("one step 2^{:.2}, two steps 2^{:.2}", one.log2(), two.log2());
        assert!(one < 2f64.powi(-17) && two < 2f64.powi(-29));
        assert!(one > 2f64.powi(-19), "the bound is not tested");
    }
}
