//! Systems of linear equations with `f32` coefficients, in integers: barycentric coordinates, frames and planes as what
//! they are solutions of.

use crate::rational::Rational;
use num_bigint::{BigInt, Sign};
use num_traits::{Signed, Zero};
use std::array::from_fn;

/// `x` in units of 2^-149, of which every finite f32 is a multiple.
///
/// # Panics
/// When `x` is NaN or infinite.
#[must_use]
pub fn integer(x: f32) -> BigInt {
    assert!(x.is_finite(), "{x} has no exact value");
    let bits = x.to_bits();
    let (field, fraction) = (bits >> 23 & 0xff, bits & 0x7f_ffff);
    let magnitude = match field {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 1 << 23) << (field - 1),
    };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// The quotient of two integers to 128 significant bits: with a power of two for denominator, a rational is fast.
///
/// # Panics
/// When `d` is zero.
#[must_use]
pub fn quotient(n: &BigInt, d: &BigInt) -> Rational {
    let shift = 130 + d.bits().saturating_sub(n.bits());
    Rational::new((n << shift) / d, BigInt::from(1) << shift)
}

/// The solution of `rows · x = right` as numerators over one denominator, which is positive; `None` when the matrix is
/// singular.
///
/// By elimination without fractions (Bareiss 1968): divisions by the previous pivot leave no remainder.
#[must_use]
pub fn solve<const N: usize>(
    mut rows: [[BigInt; N]; N],
    mut right: [BigInt; N],
) -> Option<([BigInt; N], BigInt)> {
    let mut previous = BigInt::from(1);
    for pivot in 0..N {
        let found = (pivot..N).find(|&row| !rows[row][pivot].is_zero())?;
        rows.swap(pivot, found);
        right.swap(pivot, found);
        let (top, top_right) = (rows[pivot].clone(), right[pivot].clone());
        for row in (0..N).filter(|&row| row != pivot) {
            let factor = rows[row][pivot].clone();
            rows[row] =
                from_fn(|column| (&top[pivot] * &rows[row][column] - &factor * &top[column]) / &previous);
            right[row] = (&top[pivot] * &right[row] - factor * &top_right) / &previous;
        }
        previous = top[pivot].clone();
    }
    // Every row now has the last pivot on its diagonal, and nothing else.
    match previous.sign() {
        Sign::Minus => Some((right.map(|n| -n), previous.abs())),
        _ => Some((right, previous)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{from_f32, from_int};
    use crate::rng::{Rng, run_seed};

    #[test]
    fn integers_are_the_rationals_scaled() {
        let mut rng = Rng::new(run_seed());
        let scale = Rational::from_integer(BigInt::from(1) << 149);
        for _ in 0..10_000 {
            let x = rng.finite_f32();
            assert_eq!(Rational::from_integer(integer(x)), from_f32(x) * &scale);
        }
    }

    #[test]
    fn quotients_have_the_bits_that_they_promise() {
        let third = quotient(&BigInt::from(-1), &BigInt::from(3));
        let error = third * from_int(3) + from_int(1);
        assert!(error.abs() * Rational::from_integer(BigInt::from(1) << 128) < from_int(1));
        assert_eq!(
            quotient(&(BigInt::from(1) << 300), &BigInt::from(4)),
            from_int(1 << 100) * from_int(1 << 100) * from_int(1 << 98)
        );
    }

    #[test]
    fn solutions_satisfy_their_equations() {
        let mut rng = Rng::new(run_seed());
        let mut singular = 0;
        for _ in 0..20_000 {
            let rows: [[BigInt; 3]; 3] = from_fn(|_| from_fn(|_| rng.range(-3, 3).into()));
            let right: [BigInt; 3] = from_fn(|_| rng.range(-9, 9).into());
            let determinant: BigInt = (0..3)
                .map(|i| {
                    &rows[0][i]
                        * (&rows[1][(i + 1) % 3] * &rows[2][(i + 2) % 3]
                            - &rows[1][(i + 2) % 3] * &rows[2][(i + 1) % 3])
                })
                .sum();
            let Some((x, d)) = solve(rows.clone(), right.clone()) else {
                assert!(determinant.is_zero());
                singular += 1;
                continue;
            };
            assert!(d.is_positive() && !determinant.is_zero());
            for (row, right) in rows.iter().zip(right) {
                assert_eq!(row.iter().zip(&x).map(|(a, x)| a * x).sum::<BigInt>(), right * &d);
            }
        }
        assert!(singular > 100);
    }
}
