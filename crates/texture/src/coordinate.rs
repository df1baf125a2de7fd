//! From a texture coordinate to fixed point: space in is `u` or `v` as any `f32`, space out is the coordinate
//! modulo 2 with [`FRACTION_BITS`] bits of fraction.
//!
//! Everything after this is integers, so that there is one rounding to reason about, and it is none for every
//! `f32` that matters. With sides of up to 2^14 texels, the borders between texels in the period from 0 to 1 are
//! `j / size`; the first is at or beyond 2^-14. A float next to it or further out is at least 2^-15, its last bit
//! is worth at least 2^-15-23 = 2^-38, and so 38 bits of fraction hold it exactly. A float nearer to 0 is rounded
//! down by less than 2^-38, which takes it neither to the first border nor from one side of 0 to the other. Distances
//! from the centres of texels are finer, so for these such floats are looked at [again](near_zero).
//!
//! The budget of 64 bits: 39 for the coordinate modulo 2, 14 for the size, 8 for the weights of a filter.

/// Bits of fraction of a fixed-point coordinate.
pub(crate) const FRACTION_BITS: u32 = 38;

/// 1.0 as a fixed-point coordinate.
pub(crate) const ONE: u64 = 1 << FRACTION_BITS;

/// The bits of a coordinate modulo 2.
const MODULO_2: u64 = 2 * ONE - 1;

/// Machines that add in `f64` in a cycle or so; the others decode the float as an integer.
const HAS_F64: bool = cfg!(any(
    target_arch = "x86_64",
    target_arch = "x86",
    target_arch = "aarch64",
    target_arch = "riscv64",
    target_arch = "loongarch64",
    target_arch = "powerpc64",
    target_arch = "s390x",
    target_arch = "wasm32",
    target_arch = "wasm64",
));

/// A float that is aligned so that the last bit of its sum with a small number is worth 2^-38:
/// 2^14 <= `ALIGN` + u < 2^15 for |u| < 2^13.
const ALIGN: f64 = 1.5 * 16384.0;

/// The coordinate modulo 2, rounded down to a multiple of 2^-38; 0 for infinities and NaN.
///
/// # Cost
/// A conversion, two additions, a comparison, a move, a mask and a check of the exponent, for |u| < 2^13. Beyond, a
/// call.
#[inline]
pub(crate) fn modulo_2(u: f32) -> u64 {
    if !HAS_F64 {
        return modulo_2_integer(u);
    }
    let sum = down(u);
    if sum >> 52 == ALIGN.to_bits() >> 52 { sum & MODULO_2 } else { modulo_2_far(u) }
}

/// The coordinate clamped to 0 and 1 - 2^-38, rounded down to a multiple of 2^-38; 0 for NaN.
///
/// # Cost
/// A conversion, two additions, a comparison, a maximum, a minimum, a move and a mask, for all coordinates.
#[inline]
pub(crate) fn clamped(u: f32) -> u64 {
    if !HAS_F64 {
        return match u {
            1.0.. => ONE - 1,
            0.0..1.0 => modulo_2_integer(u),
            _ => 0,
        };
    }
    // Below, NaN must become 0. Above, numbers are in order as integers too, and compilers carry a choice between
    // float constants through all that follows.
    let u = if u > 0.0 { u } else { 0.0 };
    (down(u) - ALIGN.to_bits()).min(ONE - 1)
}

/// The coordinate from -1 to 2, rounded down to a multiple of 2^-38, in two's complement.
///
/// # Cost
/// A conversion, two additions, a comparison, a move and a subtraction.
#[inline]
pub(crate) fn bounded(u: f32) -> u64 {
    if !HAS_F64 {
        return modulo_2_integer(u).wrapping_sub(if u < 0.0 { 2 * ONE } else { 0 });
    }
    down(u).wrapping_sub(ALIGN.to_bits())
}

/// The way from the centre of the leftmost texel to a reduced coordinate in 2^-`bits`, at most 8, rounded to nearest,
/// halves up. Not for those [near 0](near_zero).
#[inline]
pub(crate) fn position(reduced: u64, size: u32, bits: u32) -> i32 {
    // In `Border` it may be negative.
    rounded::<FRACTION_BITS>(reduced.cast_signed(), size, bits)
}

/// [`position`] of a coordinate that 38 bits of fraction do not hold: below 0, left of the leftmost centre. None
/// for others.
///
/// It is rounded down to 2^-47. Nearer to 0 than 2^-23 is no place where the 256ths change.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "below 2^32")]
pub(crate) fn near_zero(u: f32, size: u32, bits: u32) -> Option<i32> {
    const SMALL: f32 = 1.0 / 32768.0;
    const BITS: u32 = 47;

    (-SMALL < u && u < SMALL).then(|| {
        let scaled = u * (131_072.0 / (SMALL * SMALL));
        let whole = scaled as i64;
        // Where the conversion rounded up, which it does to no more than 24 bits.
        #[expect(clippy::cast_precision_loss, reason = "as many bits as there were")]
        let down = whole - i64::from(whole as f32 > scaled);
        rounded::<BITS>(down, size, bits)
    })
}

/// The 2^-`bits` of a coordinate with so many bits of fraction.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the shift leaves 24 bits")]
fn rounded<const BITS: u32>(coordinate: i64, size: u32, bits: u32) -> i32 {
    let shift = BITS - bits;
    // Half a unit to round to nearest, less half a texel. In 39 + 14 bits and a sign.
    let offset = (1 << (shift - 1)) - (1 << (BITS - 1));
    ((coordinate * i64::from(size) + offset) >> shift) as i32
}

/// The bits of `ALIGN` + u, rounded down, for |u| < 2^13.
#[inline]
fn down(u: f32) -> u64 {
    let u = f64::from(u);
    let sum = u + ALIGN;
    sum.to_bits().wrapping_sub(u64::from(sum - ALIGN > u))
}

#[cold]
#[inline(never)]
fn modulo_2_far(u: f32) -> u64 {
    modulo_2_integer(u)
}

/// [`modulo_2`] without floating point.
#[inline]
fn modulo_2_integer(u: f32) -> u64 {
    /// The exponent field at which the significand counts units of 2^-38.
    const UNIT: u32 = 127 + 23 - FRACTION_BITS;

    let bits = u.to_bits();
    let exponent = bits >> 23 & 0xff;
    let significand = u64::from(bits & 0x007f_ffff | 0x0080_0000);
    // Shifts of 39 and more leave a multiple of 2; so infinities and NaN come out as 0 too.
    let (magnitude, rest) = if exponent >= UNIT + 39 {
        (0, 0)
    } else if exponent >= UNIT {
        (significand << (exponent - UNIT), 0)
    } else {
        // Bits lost below make a negative number one unit less. 0 and -0 have no significand.
        let shift = (UNIT - exponent).min(24);
        let significand = if bits << 1 == 0 { 0 } else { significand };
        (significand >> shift, significand & ((1 << shift) - 1))
    };
    let signed = if bits >> 31 == 0 { magnitude } else { (magnitude + u64::from(rest != 0)).wrapping_neg() };
    signed & MODULO_2
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In `f64`, where a scaling by a power of two, rounding and the remainder are exact.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer from 0 to 2^39")]
    fn oracle(u: f32) -> u64 {
        if !u.is_finite() {
            return 0;
        }
        let scaled = (f64::from(u) * 2f64.powi(38)).floor();
        scaled.rem_euclid(2f64.powi(39)) as u64
    }

    fn check(bits: u32) {
        let u = f32::from_bits(bits);
        let expected = oracle(u);
        assert_eq!(modulo_2(u), expected, "{u:e}, {bits:#x}");
        assert_eq!(modulo_2_integer(u), expected, "{u:e}, {bits:#x}");
        let expected = match u {
            0.0..1.0 => expected,
            1.0.. => ONE - 1,
            _ => 0,
        };
        assert_eq!(clamped(u), expected, "{u:e}, {bits:#x}");
        if (-1.0..2.0).contains(&u) {
            let expected = oracle(u).cast_signed() - if u < 0.0 { 2 * ONE.cast_signed() } else { 0 };
            assert_eq!(bounded(u).cast_signed(), expected, "{u:e}, {bits:#x}");
        }
    }

    /// The 256ths by 128 bits, at the floats beside the places where they change, and anywhere.
    #[test]
    fn distances_near_zero_are_correctly_rounded() {
        let exact = |u: f32, size: u32| {
            let (significand, exponent) = if u == 0.0 { (0, 0) } else { decoded(u) };
            // In units of 2^-81, as no more than 81 bits behind the point can decide.
            let shift = exponent + 81;
            let scaled = if shift >= 0 { significand << shift } else { significand >> -shift };
            (scaled * i128::from(size) * 256 + (1 << 80) - (128 << 81)) >> 81
        };
        let mut changes = 0;
        for size in [1u16, 2, 3, 5, 97, 1000, 4328, 8191, 10_007, 16_383, 16_384] {
            let check = |u: f32| {
                let found = near_zero(u, size.into(), 8).map(i128::from);
                assert_eq!(
                    found,
                    (u.abs() < 2f32.powi(-15)).then(|| exact(u, size.into())),
                    "{u:e} of {size}"
                );
            };
            for odd in (-255i16..256).step_by(2) {
                let change = f32::from(odd) / (512.0 * f32::from(size));
                let bits = change.abs().to_bits();
                (bits - 4..bits + 4).for_each(|bits| check(f32::from_bits(bits).copysign(change)));
                changes += 1;
            }
            for bits in (0..0x3900_0000u32).step_by(99_991) {
                check(f32::from_bits(bits));
                check(-f32::from_bits(bits));
            }
        }
        assert_eq!(near_zero(-6.769_148_5e-6, 4328, 8).map(|position| position & 255), Some(121));
        assert_eq!((near_zero(f32::NAN, 3, 8), changes), (None, 11 * 256));
    }

    /// The significand with its sign, and the exponent of its last bit.
    fn decoded(u: f32) -> (i128, i32) {
        let (field, low) = (u.to_bits() >> 23 & 0xff, i128::from(u.to_bits() & 0x007f_ffff));
        let (magnitude, exponent) =
            if field == 0 { (low, -149) } else { (low | 0x0080_0000, field.cast_signed() - 150) };
        (if u < 0.0 { -magnitude } else { magnitude }, exponent)
    }

    /// All 2^32 of them take some minutes: `cargo xtask sweep`.
    #[test]
    fn every_257th_float() {
        let step = if std::env::var_os("ALBERTI_SWEEP").is_some() { 1 } else { 257 };
        (0..=u32::MAX).step_by(step).for_each(check);
    }

    #[test]
    fn around_powers_of_two() {
        for exponent in 0..=255u32 {
            for low in (0..40).chain(0x007f_ffd8..0x0080_0000).chain(0x003f_fff0..0x0040_0010) {
                check(exponent << 23 | low);
                check(1 << 31 | exponent << 23 | low);
            }
        }
    }
}
