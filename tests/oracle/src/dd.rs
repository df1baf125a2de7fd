//! Double-double arithmetic: sums of two f64 with about 106 bits, for checks that rationals are too slow for.
//!
//! The algorithms and their bounds are those of Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic", ACM TOMS 44(2), 2017. With `u = 2^-53`, and barring underflow and
//! overflow, the relative errors are: sum `3u^2 + 13u^3`, product by an f64 `2u^2`, quotient `15u^2 + 56u^3`.

use crate::coverage::{Triangle, weights};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The unevaluated sum `hi + lo`, where `hi` is that sum rounded to nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dd {
    /// The leading part.
    pub hi: f64,
    /// What rounding to `hi` left over.
    pub lo: f64,
}

impl Dd {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The exact product of two f64, barring underflow.
    #[must_use]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        Self { hi, lo: a.mul_add(b, -hi) }
    }

    /// The exact value of an integer below `2^106` in magnitude.
    #[must_use]
    pub fn from_i128(value: i128) -> Self {
        debug_assert!(value.unsigned_abs() < 1 << 106, "{value} does not fit 106 bits");
        let hi = value as f64;
        // At most half an ulp of hi, which is below 2^53: exact.
        let lo = (value - hi as i128) as f64;
        Self { hi, lo }
    }

    /// The nearest f64.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.hi
    }

    /// How far `got` is from this value, in units of `2^-24 * scale` and with its sign.
    #[must_use]
    pub fn error_in_eps(self, got: f32, scale: f64) -> f64 {
        (Self::from(f64::from(got)) - self).hi / (scale * (-24f64).exp2())
    }
}

impl From<f64> for Dd {
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Neg for Dd {
    type Output = Self;

    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

/// The paper's algorithm 6, whose relative bound holds under cancellation too.
impl Add for Dd {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let s = two_sum(self.hi, other.hi);
        let t = two_sum(self.lo, other.lo);
        let v = fast_two_sum(s.hi, s.lo + t.hi);
        fast_two_sum(v.hi, t.lo + v.lo)
    }
}

impl Sub for Dd {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// The paper's algorithm 9.
impl Mul<f64> for Dd {
    type Output = Self;

    fn mul(self, y: f64) -> Self {
        let c = Self::product(self.hi, y);
        fast_two_sum(c.hi, self.lo.mul_add(y, c.lo))
    }
}

/// The paper's algorithm 17.
impl Div for Dd {
    type Output = Self;

    fn div(self, y: Self) -> Self {
        let quotient = self.hi / y.hi;
        let r = y * quotient;
        let rest = (self.hi - r.hi) + (self.lo - r.lo);
        fast_two_sum(quotient, rest / y.hi)
    }
}

/// The perspective-correct value `sum(E_i q_i u_i) / sum(E_i q_i)` at `sample`, as [`crate::rational::hyperbolic`].
///
/// # Precision
/// For a sample inside the triangle or on its border, positive `q` and coordinates up to `2^23`, the error is below
/// `2^-100 * max|u|`: the weights are below `2^53`, so `t_i = E_i q_i` is exact; a product `t_i u_i` has `2u^2`; two
/// sums of three terms have `6u^2` of the sum of the magnitudes, above and below the bar; the quotient has `15u^2`.
/// Together `(2 + 6 + 6 + 15) u^2 max|u| = 29 * 2^-106 max|u|`.
///
/// # Cost
/// About twenty f64 fused operations and six i128 products, some hundred times less than rationals.
#[must_use]
pub fn hyperbolic(tri: Triangle, sample: [i64; 2], q: [f32; 3], u: [f32; 3]) -> Dd {
    let e = weights(tri, sample);
    weighted_mean(std::array::from_fn(|i| Dd::from_i128(e[i]) * f64::from(q[i])), u)
}

/// The value `sum(E_i u_i) / sum(E_i)`, linear on the screen, as [`crate::rational::linear`] and with the bound of
/// [`hyperbolic`].
#[must_use]
pub fn linear(tri: Triangle, sample: [i64; 2], u: [f32; 3]) -> Dd {
    weighted_mean(weights(tri, sample).map(Dd::from_i128), u)
}

fn weighted_mean(t: [Dd; 3], u: [f32; 3]) -> Dd {
    let term = |i: usize| t[i] * f64::from(u[i]);
    (term(0) + term(1) + term(2)) / (t[0] + t[1] + t[2])
}

fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let a_part = hi - b;
    let b_part = hi - a_part;
    Dd { hi, lo: (a - a_part) + (b - b_part) }
}

/// Exact when `a` is zero or has at least the exponent of `b`.
fn fast_two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    Dd { hi, lo: b - (hi - a) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::rational::{self, Rational};
    use crate::rng::{Rng, run_seed};
    use num_traits::{Signed, ToPrimitive, Zero};

    fn exact(x: Dd) -> Rational {
        rational::from_f64(x.hi) + rational::from_f64(x.lo)
    }

    /// The error of `got` relative to `want`, in units of `2^-106`.
    fn units(got: Dd, want: &Rational) -> f64 {
        let error = (exact(got) - want).abs();
        if want.is_zero() {
            assert!(error.is_zero());
            return 0.0;
        }
        (error / want.abs()).to_f64().unwrap() * 106f64.exp2()
    }

    fn operand(rng: &mut Rng) -> Dd {
        let hi = rng.uniform(-1.0, 1.0) * rng.uniform(-60.0, 60.0).exp2();
        two_sum(hi, hi * rng.uniform(-1.0, 1.0) * rng.uniform(-70.0, -53.0).exp2())
    }

    #[test]
    fn every_operation_keeps_the_bound_of_the_paper() {
        let mut rng = Rng::new(run_seed());
        let mut worst = [0f64; 4];
        for _ in 0..10_000 {
            let (x, y, f) = (operand(&mut rng), operand(&mut rng), rng.uniform(-1e9, 1e9));
            // Half of the sums cancel heavily.
            let y = if rng.one_in(2) { -x + Dd::from(x.lo * 3.0) } else { y };
            let results = [
                (x + y, exact(x) + exact(y)),
                (x - y, exact(x) - exact(y)),
                (x * f, exact(x) * rational::from_f64(f)),
                (x / y, exact(x) / exact(y)),
            ];
            for (worst, (got, want)) in worst.iter_mut().zip(results) {
                *worst = worst.max(units(got, &want));
            }
        }
        println!("worst errors of + - * / in 2^-106: {worst:?}");
        for (worst, bound) in worst.into_iter().zip([3.01, 3.01, 2.0, 15.01]) {
            assert!(worst <= bound, "{worst} > {bound}");
        }
    }

    #[test]
    fn products_of_f64_and_integers_are_exact() {
        let mut rng = Rng::new(run_seed());
        for _ in 0..10_000 {
            let (a, b) = (rng.uniform(-1e6, 1e6), rng.uniform(-1e-6, 1e-6));
            let product = rational::from_f64(a) * rational::from_f64(b);
            assert_eq!(exact(Dd::product(a, b)), product);
            let n = i128::from(rng.u64() as i64) * i128::from(rng.range(-1 << 42, 1 << 42));
            assert_eq!(exact(Dd::from_i128(n)), Rational::from_integer(n.into()));
        }
    }

    #[test]
    fn interpolation_is_within_two_to_the_minus_hundred_of_the_rationals() {
        let mut rng = Rng::new(run_seed());
        let (mut worst, mut checked) = (0f64, 0);
        let bar = (-100f64).exp2();
        while checked < 3_000 {
            let case = cases::any(&mut rng, 8, 1 << 23);
            if !crate::coverage::covers(case.tri, case.sample) {
                continue;
            }
            let ratio = [1.0, 1e3, 1e6, 1e12][rng.index(4)];
            let q = [(); 3].map(|()| rng.log_uniform(1.0, ratio));
            let u =
                [(); 3].map(|()| rng.log_uniform(1e-3, 8_388_608.0) * if rng.one_in(2) { -1.0 } else { 1.0 });
            let scale = rational::from_f64(u.map(|u| f64::from(u).abs()).into_iter().fold(0.0, f64::max));
            for (got, want) in [
                (hyperbolic(case.tri, case.sample, q, u), rational::hyperbolic(case.tri, case.sample, q, u)),
                (linear(case.tri, case.sample, u), rational::linear(case.tri, case.sample, u)),
            ] {
                let error = ((exact(got) - want).abs() / &scale).to_f64().unwrap();
                worst = worst.max(error);
                assert!(error <= bar, "{error:e} in {case:?}, q {q:?}, u {u:?}");
            }
            checked += 1;
        }
        println!("worst error: 2^{:.2} of max|u|", worst.log2());
    }

    #[test]
    fn errors_are_measured_in_half_ulps_of_one() {
        let value = Dd::from(1.0) + Dd::from((-80f64).exp2());
        let off = value.error_in_eps(1.0 + f32::EPSILON, 1.0);
        assert!((off - 2.0).abs() < 1e-9, "{off}");
        assert!(value.error_in_eps(1.0 - f32::EPSILON, 2.0) < -0.99);
    }
}
