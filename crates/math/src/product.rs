//! The high words of products, also on cores whose multiplication gives only the low one (Cortex-M0).

/// Whether the target is such a core, which has no division either: of those with Arm's instructions, the ones without
/// atomic exchange.
pub const LOW_WORDS_ONLY: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// The highest 32 bits of the product of two words: a·b/2^32, rounded down.
///
/// # Cost
/// One multiplication of 32 bits to 64. On cores without one four of 16 bits to 32, seventeen instructions in all.
#[must_use]
#[inline(always)]
pub const fn high(a: u32, b: u32) -> u32 {
    if LOW_WORDS_ONLY { high_of_halves(a, b) } else { ((a as u64 * b as u64) >> 32) as u32 }
}

/// [`high`] of signed numbers.
#[must_use]
#[inline(always)]
pub const fn high_signed(a: i32, b: i32) -> i32 {
    if LOW_WORDS_ONLY { high_signed_of_halves(a, b) } else { ((a as i64 * b as i64) >> 32) as i32 }
}

/// The product of a word and a half word without its lowest 16 bits: a·b/2^16, rounded down.
#[must_use]
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a product of 48 bits, 16 of which go")]
pub const fn middle(a: i32, b: i16) -> i32 {
    if LOW_WORDS_ONLY { middle_of_halves(a, b) } else { ((a as i64 * b as i64) >> 16) as i32 }
}

/// [`high`] of a word whose lowest 16 bits are 0: `a` are the others.
#[must_use]
#[inline(always)]
pub const fn high_of_half(a: u16, b: u32) -> u32 {
    if LOW_WORDS_ONLY { half_by_halves(a, b) } else { high((a as u32) << 16, b) }
}

const LAST: u32 = 0xffff;

/// By signed ones: compilers know the unsigned form, and make a call of 64 bits of it.
#[inline(always)]
const fn high_of_halves(a: u32, b: u32) -> u32 {
    let [a, b] = [a.cast_signed(), b.cast_signed()];
    let more = ((a >> 31) & b).wrapping_add((b >> 31) & a);
    high_signed_of_halves(a, b).wrapping_add(more).cast_unsigned()
}

#[inline(always)]
const fn half_by_halves(a: u16, b: u32) -> u32 {
    let a = a as u32;
    a * (b >> 16) + ((a * (b & LAST)) >> 16)
}

#[inline(always)]
const fn high_signed_of_halves(a: i32, b: i32) -> i32 {
    let last = LAST.cast_signed();
    let ([a1, a0], [b1, b0]) = ([a >> 16, a & last], [b >> 16, b & last]);
    let lowest = (a0.cast_unsigned() * b0.cast_unsigned()) >> 16;
    let first = a1 * b0 + lowest.cast_signed();
    let second = a0 * b1 + (first & last);
    a1 * b1 + (first >> 16) + (second >> 16)
}

#[inline(always)]
const fn middle_of_halves(a: i32, b: i16) -> i32 {
    let b = b as i32;
    (a >> 16) * b + (((a & LAST.cast_signed()) * b) >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: [u32; 12] = [
        0,
        1,
        0xffff,
        0x1_0000,
        0x7fff_ffff,
        0x8000_0000,
        0x8000_ffff,
        0xffff_0000,
        0xffff_ffff,
        0x0001_ffff,
        0x1234_5678,
        0x9abc_def0,
    ];

    #[test]
    fn products_of_halves_are_those_of_the_whole() {
        let mut word = 1u32;
        for i in 0..20_000 {
            let next = || word.wrapping_mul(0x9e37_79b1).wrapping_add(i) ^ word >> 15;
            for a in WORDS.into_iter().chain([word, next()]) {
                for b in WORDS.into_iter().chain([word, next()]) {
                    let wide = (u64::from(a) * u64::from(b)) >> 32;
                    assert_eq!(u64::from(high_of_halves(a, b)), wide);
                    #[expect(clippy::cast_possible_truncation, reason = "any half word")]
                    let half = a as u16;
                    let wide = (u64::from(half) * u64::from(b)) >> 16;
                    assert_eq!(u64::from(half_by_halves(half, b)), wide);
                    assert_eq!(high_of_half(half, b), half_by_halves(half, b));
                    let [a, b] = [a, b].map(u32::cast_signed);
                    let wide = (i64::from(a) * i64::from(b)) >> 32;
                    assert_eq!(i64::from(high_signed_of_halves(a, b)), wide);
                    #[expect(clippy::cast_possible_truncation, reason = "any half word")]
                    let half = b as i16;
                    let wide = (i64::from(a) * i64::from(half)) >> 16;
                    assert_eq!(i64::from(middle_of_halves(a, half)), wide);
                    assert_eq!(middle(a, half), middle_of_halves(a, half));
                }
            }
            word = next();
        }
    }
}
