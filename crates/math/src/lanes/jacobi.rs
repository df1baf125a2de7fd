//! The rotation that makes two vectors orthogonal.
//!
//! With p = |x|² - |y|² and q = 2 x·y, tan 2θ = q/p, and tan θ = ±q/(|p| + √(p² + q²)): nothing cancels, and |θ| is at
//! most 45°. Vectors are scaled before, as only their ratios matter and p² + q² has the fourth power of lengths.

use super::Lanes;
use crate::Q16;

#[inline(always)]
pub(super) fn floating<L: Lanes>(
    lanes: L,
    x: [L::Number; 2],
    y: [L::Number; 2],
    scale: [u32; 2],
) -> [L::Number; 2] {
    let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
    let magnitude = |x: L::Number| lanes.max(x, zero - x);
    #[expect(clippy::cast_precision_loss, reason = "up to 2^15")]
    let [s, t] = scale.map(|scale| lanes.splat(scale as f32));
    let ([x0, x1], [y0, y1]) = ([x[0] * s, x[1] * t], [y[0] * s, y[1] * t]);
    // The longest component becomes 1; what is 0, infinite or too small for that becomes NaN.
    let greatest =
        lanes.max(lanes.max(magnitude(x0), magnitude(x1)), lanes.max(magnitude(y0), magnitude(y1)));
    let to_unit = one / greatest;
    let [x0, x1, y0, y1] = [x0, x1, y0, y1].map(|x| x * to_unit);
    let (p, q) = (x0 * x0 + x1 * x1 - (y0 * y0 + y1 * y1), lanes.splat(2.0) * (x0 * y0 + x1 * y1));
    let (adjacent, opposite) = (magnitude(p), magnitude(q));
    // The root is 0 where squares vanish, although q need not be.
    let below = adjacent + lanes.max(lanes.sqrt(p * p + q * q), opposite);
    let tangent = lanes.select(lanes.less(p, zero), zero - q, q) / below;
    let tangent = lanes.select(lanes.less(zero, below), tangent, zero);
    let cosine = one / lanes.sqrt(one + tangent * tangent);
    [cosine, tangent * cosine]
}

#[inline]
pub(super) fn fixed(x: [Q16; 2], y: [Q16; 2], scale: [u32; 2]) -> [Q16; 2] {
    // At most 2^46.
    let scaled = |v: [Q16; 2]| [0, 1].map(|i| i64::from(v[i].to_bits()) * i64::from(scale[i]));
    let ([x0, x1], [y0, y1]) = (scaled(x), scaled(y));
    let [x0, x1, y0, y1] = below_2_to_30([x0, x1, y0, y1]);
    let (p, q) = (x0 * x0 + x1 * x1 - (y0 * y0 + y1 * y1), 2 * (x0 * y0 + x1 * y1));
    let [p, q] = below_2_to_30([p, q]);
    let hypotenuse = (p * p + q * q).unsigned_abs().isqrt();
    // In units of 2^-30.
    let tangent = (q.unsigned_abs() << 30).checked_div(p.unsigned_abs() + hypotenuse).unwrap_or(0);
    let secant = ((1 << 60) + tangent * tangent).isqrt();
    #[expect(clippy::cast_possible_truncation, reason = "at most 2^16")]
    let [cosine, sine] = [1 << 30, tangent].map(|x| (((x << 17) / secant + 1) >> 1) as u32);
    let sine = sine.cast_signed();
    [Q16::from_bits(cosine.cast_signed()), Q16::from_bits(if (p < 0) == (q < 0) { sine } else { -sine })]
}

/// Integers below 2^62, moved up or down until the longest has 30 bits.
#[inline]
fn below_2_to_30<const N: usize>(numbers: [i64; N]) -> [i64; N] {
    let zeros = numbers.iter().fold(1, |bits, x| bits | x.unsigned_abs()).leading_zeros();
    numbers.map(|x| x << (zeros - 1) >> 33)
}

#[cfg(test)]
mod tests {
    use super::super::{Lanes, Machine, One, OneFixed};
    use super::*;
    use crate::for_lanes;

    struct Noise(u32);

    impl Noise {
        fn bits(&mut self) -> u32 {
            self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            self.0 ^ self.0 >> 13
        }

        fn unit(&mut self) -> f64 {
            f64::from(self.bits()) / 2f64.powi(32)
        }
    }

    /// The distance of a rotation from being one, and the bound's |sin 2Δθ|·(A² - B²)/2A². With x' and y' the vectors
    /// that it makes in `f64`, A² - B² is √(p² + q²) of any rotation of them, and |sin 2Δθ| is |2 x'·y'| of that.
    fn errors([x, y]: [[f64; 2]; 2], [cosine, sine]: [f64; 2]) -> [f64; 2] {
        let square = cosine * cosine + sine * sine;
        let turned = |a: [f64; 2], b: [f64; 2], s: f64| [0, 1].map(|i| a[i] * cosine + s * b[i] * sine);
        let (x, y) = (turned(x, y, 1.0), turned(y, x, -1.0));
        let dot = |a: [f64; 2], b: [f64; 2]| (a[0] * b[0] + a[1] * b[1]) / square;
        let (p, q) = (dot(x, x) - dot(y, y), 2.0 * dot(x, y));
        let major = (dot(x, x) + dot(y, y) + p.hypot(q)) / 2.0;
        assert!(sine.abs() <= cosine * (1.0 + 1e-4), "more than 45 degrees");
        [(square - 1.0).abs(), q.abs() / 2.0 / major]
    }

    /// An ellipse whose axes have a ratio up to 2^20, turned by any angle on both sides.
    fn vectors(noise: &mut Noise, scale: [u32; 2]) -> [[f64; 2]; 2] {
        let ratio =
            2f64.powf(if noise.bits().is_multiple_of(3) { noise.unit() } else { noise.unit() * 20.0 });
        let [(s, c), (t, d)] = [(); 2].map(|()| (noise.unit() * 7.0).sin_cos());
        let scale = scale.map(f64::from);
        let (a, b) = ([c / scale[0], s / scale[1]], [-s / ratio / scale[0], c / ratio / scale[1]]);
        [[0, 1].map(|i| d * a[i] + t * b[i]), [0, 1].map(|i| d * b[i] - t * a[i])]
    }

    fn scaled(v: [[f64; 2]; 2], scale: [u32; 2]) -> [[f64; 2]; 2] {
        v.map(|v| [v[0] * f64::from(scale[0]), v[1] * f64::from(scale[1])])
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "rounded on purpose")]
    fn floats() {
        let mut noise = Noise(1);
        let mut worst = [0.0f64; 2];
        for _ in 0..300_000 {
            let scale = [1 + noise.bits() % 0x8000, 1 + noise.bits() % 0x8000];
            let size = 2f64.powi((noise.bits() % 124).cast_signed() - 62);
            let [x, y] = vectors(&mut noise, scale).map(|v| v.map(|x| (x * size) as f32));
            let found = One.jacobi_rotation(x, y, scale);
            let exact = scaled([x, y].map(|v| v.map(|x| f64::from(x) / size)), scale);
            let each = errors(exact, found.map(f64::from));
            worst = [0, 1].map(|i| worst[i].max(each[i] * 2f64.powi(24)));
            for machine in Machine::all() {
                let same = for_lanes!(machine, lanes => {
                    let [x, y] = [x, y].map(|v| v.map(|x| lanes.splat(x)));
                    lanes.jacobi_rotation(x, y, scale).map(|x| {
                        let each = lanes.store(x);
                        each.as_ref()[3 % each.as_ref().len()]
                    })
                });
                assert_eq!(same.map(f32::to_bits), found.map(f32::to_bits));
            }
        }
        std::println!("Jacobi rotations: {:.2}ε from 1, axes {:.2}ε", worst[0], worst[1]);
        assert!((3.0..=6.0).contains(&worst[0]) && (2.0..=8.0).contains(&worst[1]), "{worst:?}");
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "within 16 bits")]
    fn integers() {
        let mut noise = Noise(2);
        let mut worst = [0.0f64; 2];
        for i in 0..300_000 {
            let scale = [1 + noise.bits() % 0x8000, 1 + noise.bits() % 0x8000];
            let size = 2f64.powi((noise.bits() % 40).cast_signed());
            let quantized = |x: f64| Q16::from_bits((x * size * 1024.0) as i32);
            let mut v = vectors(&mut noise, scale).map(|v| v.map(quantized));
            if i % 4 == 0 {
                v = v.map(|v| v.map(|_| Q16::from_bits(noise.bits().cast_signed() >> (noise.bits() % 32))));
            }
            let found = OneFixed.jacobi_rotation(v[0], v[1], scale);
            let exact = scaled(v.map(|v| v.map(|x| f64::from(x.to_bits()))), scale);
            if exact.as_flattened().iter().all(|&x| x.abs() <= 0.0) {
                assert_eq!(found, [Q16::ONE, Q16::ZERO]);
                continue;
            }
            let each = errors(exact, found.map(|x| f64::from(x.to_bits()) / 65536.0));
            worst = [0, 1].map(|i| worst[i].max(each[i] * 32768.0));
        }
        std::println!("Jacobi rotations in integers: {:.3} and {:.3} of 2^-15", worst[0], worst[1]);
        assert!((0.3..=1.0).contains(&worst[0]) && (0.3..=1.0).contains(&worst[1]), "{worst:?}");
    }

    /// Vectors at right angles stay as they are, whichever is the longer one; no number turns none.
    #[test]
    fn none() {
        let mut noise = Noise(3);
        for _ in 0..10_000 {
            let any = |noise: &mut Noise| f32::from_bits(noise.bits());
            let (a, b) = (any(&mut noise), any(&mut noise));
            assert_eq!(One.jacobi_rotation([a, 0.0], [0.0, b], [300, 7]), [1.0, 0.0], "{a} {b}");
            assert_eq!(One.jacobi_rotation([0.0, a], [-b, 0.0], [1, 64]), [1.0, 0.0], "{a} {b}");
            let special = [0.0, f32::NAN, f32::INFINITY, f32::MAX, 1e-45][noise.bits() as usize % 5];
            let mut all = [a, b, any(&mut noise), special];
            all.rotate_left(noise.bits() as usize % 4);
            let [x0, x1, y0, y1] = all;
            let found = One.jacobi_rotation([x0, x1], [y0, y1], [2, 3]);
            assert!(found.iter().all(|x| x.abs() <= 1.0), "{all:?}: {found:?}");
            let finite = all.iter().all(|x| x.is_finite());
            assert!(finite || found.map(f32::to_bits) == [1f32.to_bits(), 0], "{all:?}: {found:?}");
            for machine in Machine::all() {
                let same = for_lanes!(machine, lanes => {
                    let [x, y] = [[x0, x1], [y0, y1]].map(|v| v.map(|x| lanes.splat(x)));
                    lanes.jacobi_rotation(x, y, [2, 3]).map(|x| lanes.store(x).as_ref()[0])
                });
                assert_eq!(same.map(f32::to_bits), found.map(f32::to_bits), "{all:?}");
            }
            let q = [0, 1].map(|_| Q16::from_bits(noise.bits().cast_signed()));
            let none = [Q16::ONE, Q16::ZERO];
            assert_eq!(OneFixed.jacobi_rotation([q[0], Q16::ZERO], [Q16::ZERO, q[1]], [9, 0x8000]), none);
        }
        assert_eq!(One.jacobi_rotation([0.0; 2], [0.0; 2], [1, 1]), [1.0, 0.0]);
    }
}
