//! Exact values as rationals: interpolation, clipping and depth, without a single rounding.

use crate::coverage::{Triangle, weights};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// An exact number.
pub type Rational = BigRational;

/// The exact value of a finite f32.
///
/// # Panics
/// When `x` is NaN or infinite.
#[must_use]
pub fn from_f32(x: f32) -> Rational {
    from_f64(f64::from(x))
}

/// The exact value of a finite f64.
///
/// # Panics
/// When `x` is NaN or infinite.
#[must_use]
pub fn from_f64(x: f64) -> Rational {
    // Taken apart by hand, so that no library's conversion has to be believed.
    assert!(x.is_finite(), "{x} has no exact value");
    let bits = x.to_bits();
    let field = (bits >> 52) as i32 & 0x7ff;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) = match field {
        0 if fraction == 0 => return from_int(0),
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, field - 1075),
    };
    // Odd over a power of two, so in lowest terms.
    let zeros = mantissa.trailing_zeros();
    let (odd, exponent) = (BigInt::from(mantissa >> zeros), exponent + zeros as i32);
    let power = BigInt::from(1) << exponent.unsigned_abs();
    let magnitude =
        if exponent < 0 { Rational::new_raw(odd, power) } else { Rational::from_integer(power * odd) };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// The exact value of an integer.
#[must_use]
pub fn from_int(n: i128) -> Rational {
    Rational::from_integer(n.into())
}

/// The nearest f64, for reports.
#[must_use]
pub fn to_f64(x: &Rational) -> f64 {
    x.to_f64().unwrap_or(f64::NAN)
}

/// The perspective-correct value `sum(E_i q_i u_i) / sum(E_i q_i)` of a varying at `sample`, where `E_i` is the edge
/// function opposite to vertex `i`, `q_i = 1/w_i` and `u_i` is the varying there.
///
/// # Panics
/// When the weights sum to zero, as they do for a triangle without area, or when an input is not finite.
#[must_use]
pub fn hyperbolic(tri: Triangle, sample: [i64; 2], q: [f32; 3], u: [f32; 3]) -> Rational {
    let e = weights(tri, sample);
    weighted_mean(std::array::from_fn(|i| from_int(e[i]) * from_f32(q[i])), u)
}

/// The value `sum(E_i u_i) / sum(E_i)`, linear on the screen: screen depth and `1/w` are interpolated so.
///
/// # Panics
/// When the triangle has no area or a value is not finite.
#[must_use]
pub fn linear(tri: Triangle, sample: [i64; 2], u: [f32; 3]) -> Rational {
    weighted_mean(weights(tri, sample).map(from_int), u)
}

/// One component of the point between `vi` and `vj` where the distance to a plane, `di` at one and `dj` at the other,
/// is zero: `(dj vi - di vj) / (dj - di)`.
///
/// # Panics
/// When both distances are equal, so that there is no such point.
#[must_use]
pub fn clip_lerp(vi: &Rational, vj: &Rational, di: &Rational, dj: &Rational) -> Rational {
    (dj * vi - di * vj) / (dj - di)
}

/// The exact screen depth `B/(B-A) - A B/((B-A) z)` at the distance `z`, 0 at the near plane `A` and 1 at the far one
/// `B`.
///
/// # Panics
/// When `z` is zero, both planes are equal, or a value is not finite.
#[must_use]
pub fn depth(z: f32, near: f32, far: f32) -> Rational {
    let (z, a, b) = (from_f32(z), from_f32(near), from_f32(far));
    let range = &b - &a;
    &b / &range - &a * &b / (range * z)
}

/// The exact reversed depth `-A/(B-A) + A B/((B-A) z)`, 1 at the near plane and 0 at the far one.
///
/// # Panics
/// As [`depth`].
#[must_use]
pub fn depth_reversed(z: f32, near: f32, far: f32) -> Rational {
    let (z, a, b) = (from_f32(z), from_f32(near), from_f32(far));
    let range = &b - &a;
    &a * &b / (&range * z) - a / range
}

/// The distance in eye space whose [`depth`] is `zs`: `A B / (B - zs (B - A))`.
///
/// # Panics
/// When `zs` is the depth of infinity, or a value is not finite.
#[must_use]
pub fn depth_to_z(zs: f32, near: f32, far: f32) -> Rational {
    let (zs, a, b) = (from_f32(zs), from_f32(near), from_f32(far));
    let range = &b - &a;
    let product = &a * &b;
    product / (b - zs * range)
}

/// How far `got` is from `exact`, in units of `2^-24 * scale` and with its sign; infinite or NaN when `got` is.
///
/// # Panics
/// When `scale` is not positive and finite.
#[must_use]
pub fn error_in_eps(got: f32, exact: &Rational, scale: f64) -> f64 {
    assert!(scale.is_finite() && scale > 0.0, "an error is measured against a positive scale, not {scale}");
    if !got.is_finite() {
        return f64::from(got);
    }
    // Only the difference has to be exact.
    to_f64(&(from_f32(got) - exact)) / (scale * (-24f64).exp2())
}

/// How far `got` is from `exact`, in units of the spacing of the f32 values around `exact`.
#[must_use]
pub fn error_in_ulp(got: f32, exact: &Rational) -> f64 {
    if !got.is_finite() {
        return f64::from(got);
    }
    // The exponent of the nearest f64 is that of `exact`, or one more: below a power of two it may round up to it.
    // Below the smallest normal number the spacing stays fixed.
    let nearest = to_f64(exact).abs();
    let mut exponent = ((nearest.to_bits() >> 52) as i32 - 1023).max(-126);
    if exponent > -126 && nearest == f64::from(exponent).exp2() && exact.abs() < from_f64(nearest) {
        exponent -= 1;
    }
    to_f64(&(from_f32(got) - exact)) / f64::from(exponent - 23).exp2()
}

fn weighted_mean(t: [Rational; 3], u: [f32; 3]) -> Rational {
    let numerator: Rational = (0..3).map(|i| &t[i] * from_f32(u[i])).sum();
    let denominator: Rational = t.iter().sum();
    assert!(!denominator.is_zero(), "the weights sum to zero");
    numerator / denominator
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Rng, run_seed};

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    #[test]
    fn floats_convert_exactly_and_back() {
        assert_eq!(from_f32(-0.375), ratio(-3, 8));
        assert_eq!(from_f32(-0.0), ratio(0, 1));
        assert_eq!(from_f32(16_777_216.0), ratio(1 << 24, 1));
        assert_eq!(from_f32(f32::from_bits(1)), ratio(1, 2) / Rational::from_integer(BigInt::from(1) << 148));
        let mut rng = Rng::new(run_seed());
        for _ in 0..20_000 {
            let x = rng.finite_f32();
            let there = from_f32(x);
            // Compared with the library's own conversion, which is independent of the one above.
            assert_eq!(Some(there.clone()), Rational::from_float(x));
            assert_eq!(to_f64(&there) as f32, x);
        }
    }

    #[test]
    fn the_middle_of_an_edge_in_perspective() {
        // From z = 1 to z = 3 the middle of the screen shows the point a quarter along the edge.
        let tri = [[0, 0], [16, 0], [0, 16]];
        let u = [0.0, 1.0, 5.0];
        let third = 1.0 / 3.0f32;
        let value = hyperbolic(tri, [8, 0], [1.0, third, 1.0], u);
        assert!((to_f64(&value) - 0.25).abs() < 1e-7);
        assert_eq!(linear(tri, [8, 0], u), ratio(1, 2));
        assert_eq!(hyperbolic(tri, [8, 0], [0.5; 3], u), ratio(1, 2));
        assert_eq!(linear(tri, [0, 16], u), ratio(5, 1));
    }

    #[test]
    fn clipping_is_symmetric_and_lands_on_the_plane() {
        let (vi, vj, di, dj) = (ratio(3, 1), ratio(-7, 2), ratio(-1, 3), ratio(5, 7));
        let there = clip_lerp(&vi, &vj, &di, &dj);
        assert_eq!(there, clip_lerp(&vj, &vi, &dj, &di));
        // The distance itself, clipped like any other component, is zero.
        assert!(clip_lerp(&di, &dj, &di, &dj).is_zero());
        let t = (&there - &vi) / (&vj - &vi);
        assert_eq!(&di + t * (&dj - &di), ratio(0, 1));
    }

    #[test]
    fn depth_meets_its_ends_and_its_inverse() {
        let (near, far) = (0.1, 1000.0);
        assert_eq!(depth(near, near, far), ratio(0, 1));
        assert_eq!(depth(far, near, far), ratio(1, 1));
        assert_eq!(depth_to_z(0.0, near, far), from_f32(near));
        assert_eq!(depth_to_z(1.0, near, far), from_f32(far));
        for z in [0.1, 0.75, 3.0, 999.0] {
            let sum = depth(z, near, far) + depth_reversed(z, near, far);
            assert_eq!(sum, ratio(1, 1));
        }
        // With A = 1 and B = 2, z = 4/3 would be the middle; z = 1.5 lies at 2 - 2/1.5 = 2/3.
        assert_eq!(depth(1.5, 1.0, 2.0), ratio(2, 3));
        assert_eq!(depth_to_z(0.5, 1.0, 2.0), ratio(4, 3));
    }

    #[test]
    fn errors_are_in_the_promised_units() {
        let eps = f32::EPSILON;
        let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-12, "{got} {want}");
        close(error_in_eps(1.0 + eps, &ratio(1, 1), 1.0), 2.0);
        close(error_in_eps(1.0 - eps, &ratio(1, 1), 4.0), -0.5);
        close(error_in_ulp(1.0 + eps, &ratio(1, 1)), 1.0);
        close(error_in_ulp(3.0, &(ratio(3, 1) + from_f32(eps))), -0.5);
        close(error_in_ulp(0.1, &from_f32(0.1)), 0.0);
        close(error_in_ulp(f32::from_bits(3), &from_f32(f32::from_bits(1))), 2.0);
        close(error_in_ulp(f32::from_bits(3), &ratio(0, 1)), 3.0);
        // Just below a power of two the spacing is that below it, also where the nearest f64 is the power itself.
        let below = ratio(-2, 1) + Rational::new(1.into(), BigInt::from(1) << 70);
        close(error_in_ulp(-2.0 + eps, &below), 1.0);
        close(error_in_ulp(1e30, &(from_f32(1e30) + from_f32(7.555_786_4e22))), -1.0);
        assert!(error_in_eps(f32::NAN, &ratio(1, 1), 1.0).is_nan());
    }
}
