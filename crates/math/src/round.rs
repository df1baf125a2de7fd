//! Rounding without a maths library, exact on every target.

/// The largest integer not above `x`; saturates outside the range of `i32`, and NaN gives 0.
///
/// # Cost
/// One conversion each way, a comparison, a subtraction.
#[must_use]
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "saturation is the documented result")]
#[expect(clippy::cast_precision_loss, reason = "a truncated f32 is an integer that f32 holds")]
pub const fn floor_i32(x: f32) -> i32 {
    let truncated = x as i32;
    if truncated as f32 > x { truncated.saturating_sub(1) } else { truncated }
}

/// The nearest integer to `x`, halves upwards: floor(x + 1/2) without the rounding error of that sum.
/// Saturates outside the range of `i32`, and NaN gives 0.
#[must_use]
#[inline]
#[expect(clippy::cast_precision_loss, reason = "the floor of an f32 below 2^31 is an integer that f32 holds")]
pub const fn round_half_up(x: f32) -> i32 {
    let floor = floor_i32(x);
    // Exact: both have the same ulp or the difference is below one.
    let fraction = x - floor as f32;
    if fraction >= 0.5 { floor.saturating_add(1) } else { floor }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "the values are in range")]
    fn both_agree_with_f64() {
        let mut bits = 0u32;
        loop {
            let x = f32::from_bits(bits);
            if x.abs() < 2e9 {
                let exact = f64::from(x);
                assert_eq!(i64::from(floor_i32(x)), exact.floor() as i64, "{x:e}");
                assert_eq!(i64::from(round_half_up(x)), (exact + 0.5).floor() as i64, "{x:e}");
            }
            let (next, wrapped) = bits.overflowing_add(997);
            if wrapped {
                break;
            }
            bits = next;
        }
    }

    #[test]
    fn what_f64_sums_would_get_wrong_and_what_has_no_integer() {
        // The largest f32 below one half: adding one half in f32 would give 1.
        assert_eq!(round_half_up(0.5f32.next_down()), 0);
        assert_eq!(round_half_up(0.5), 1);
        assert_eq!(round_half_up(-0.5), 0);
        assert_eq!(round_half_up((-0.5f32).next_up()), 0);
        assert_eq!(round_half_up(f32::NAN), 0);
        assert_eq!(round_half_up(f32::INFINITY), i32::MAX);
        assert_eq!(floor_i32(f32::NEG_INFINITY), i32::MIN);
        assert_eq!(floor_i32(-0.0), 0);
        assert_eq!(floor_i32(-1e-40), -1);
    }
}
