//! The number of samples at a time, and the kind of numbers: `f32` in [`One`], fixed point in [`OneFixed`]. Behind the
//! feature `simd` there are the vector registers of `Eight` and `Sixteen`.
//!
//! A kernel is written once, over a value of a [`Lanes`] type. Every lane of `f32` does the same IEEE operations in the
//! same order as one lane alone, so the width never changes a bit.

mod jacobi;
mod machine;
mod one;
mod one_fixed;
#[cfg(feature = "simd")]
mod several;

pub use machine::Machine;
pub use one::One;
pub use one_fixed::OneFixed;
#[cfg(feature = "simd")]
pub use several::{Eight, Sixteen};

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// A number of samples side by side, and the arithmetic on them.
///
/// The value itself holds nothing; it is the proof that the machine has the instructions. Code over it is inlined into
/// the function that [`vectorize`](Self::vectorize) calls, which is compiled for those.
pub trait Lanes: Copy + Debug + Send + Sync {
    /// The number of samples: a power of two, at most 16.
    const COUNT: usize;
    /// The same as a number of columns.
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "at most 16")]
    const STEP: i32 = Self::COUNT as i32;
    /// Whether numbers are in fixed point.
    const FIXED: bool;
    /// A number for each: `f32`, or [`Q16`](crate::Q16).
    type Number: Copy
        + Add<Output = Self::Number>
        + Sub<Output = Self::Number>
        + Mul<Output = Self::Number>
        + Div<Output = Self::Number>
        + Neg<Output = Self::Number>;
    /// A screen depth for each.
    type Depth: Copy;
    /// A word of 32 bits for each; arithmetic is modulo 2^32.
    type U32: Copy
        + Add<Output = Self::U32>
        + Sub<Output = Self::U32>
        + Mul<Output = Self::U32>
        + BitAnd<Output = Self::U32>
        + BitOr<Output = Self::U32>
        + BitXor<Output = Self::U32>;
    /// An integer from -2^31 to 2^31 - 1 for each.
    type Int: Copy + Add<Output = Self::Int> + BitOr<Output = Self::Int>;
    /// An integer from -2^53 to 2^53 for each.
    type Long: Copy;
    /// A truth value for each.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// Any value for each, in memory.
    type Each<T: Copy>: Copy + AsRef<[T]> + AsMut<[T]>;

    /// Runs `f`, into which the code over these lanes is inlined.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;

    /// A slice as whole groups of lanes, and the rest.
    fn groups<T: Copy>(slice: &mut [T]) -> (&mut [Self::Each<T>], &mut [T]);
    /// A value for each, by lane number.
    fn each<T: Copy>(self, f: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// The same number for each.
    fn splat(self, x: f32) -> Self::Number;
    /// The same word for each.
    fn word(self, x: u32) -> Self::U32;
    /// 0, 1, 2 and so on.
    fn ramp(self) -> Self::Number;
    /// Numbers from memory.
    fn load(self, values: &Self::Each<f32>) -> Self::Number;
    /// Numbers to memory.
    fn store(self, values: Self::Number) -> Self::Each<f32>;
    /// Copies values in memory, where the mask is set.
    fn copy_where(self, mask: Self::Mask, values: &Self::Each<f32>, to: &mut Self::Each<f32>);
    /// Whether a < b in memory; not so where one is NaN.
    fn less_in_memory(self, a: &Self::Each<f32>, b: &Self::Each<f32>) -> Self::Mask;
    /// The result of `number` for each depth where depths are numbers in [0, 1], or of `raw` where they are words.
    fn each_depth<T: Copy>(
        self,
        depth: Self::Depth,
        number: impl Fn(f32) -> T,
        raw: impl Fn(u32) -> T,
    ) -> Self::Each<T>;
    /// The words that `word` finds for these.
    fn gather(self, indices: Self::U32, word: impl FnMut(u32) -> u32) -> Self::U32;
    /// The two words that `words` finds for each of these.
    fn gather_pairs(self, indices: Self::U32, words: impl FnMut(u32) -> [u32; 2]) -> [Self::U32; 2];
    /// Words from memory.
    fn load_words(self, values: &Self::Each<u32>) -> Self::U32;
    /// Words to memory.
    fn store_words(self, values: Self::U32) -> Self::Each<u32>;

    /// The lesser of two finite numbers; of equal ones the second.
    fn min(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The greater of two finite numbers; of equal ones the second.
    fn max(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The square root, correctly rounded.
    fn sqrt(self, x: Self::Number) -> Self::Number;
    /// log2 of the length of the vector (x·`scale`\[0\], y·`scale`\[1\]), for scales up to 2^15: of derivatives of
    /// texture coordinates and the sides of a texture, the level of detail.
    ///
    /// # Precision
    /// Within 2^-11 for lengths from 2^-63 to 2^63, in fixed point from 2^-16 to 2^15, and at powers of two along an
    /// axis exact. Shorter lengths give at most the least of these, but never less than -63.5 (-16). Longer ones and
    /// NaN give at least the greatest.
    ///
    /// # Cost
    /// Nine multiplications, six additions, a minimum, a conversion and three operations on bits; no root, no table. In
    /// fixed point two products of 64 bits, and integers.
    fn log2_length(self, x: Self::Number, y: Self::Number, scale: [u32; 2]) -> Self::Number;
    /// Cosine and sine of the Jacobi rotation of two plane vectors `x` and `y` whose components are multiplied by
    /// `scale`, up to 2^15, before: it makes them orthogonal.
    ///
    /// ```text
    /// cos x + sin y  is at right angles to  cos y - sin x:      tan 2θ = 2 x·y / (|x|² - |y|²),  -45° <= θ <= 45°
    /// ```
    ///
    /// So these are the semi-axes of the ellipse into which (x y) turns the unit circle (one-sided Jacobi, Hestenes
    /// 1958). The rotation is none, exactly, where the vectors are at right angles, or where one is not finite or
    /// longer than `f32` can tell.
    ///
    /// # Precision
    /// With the longest component of the scaled vectors from 2^-63 to 2^63, cos² + sin² is 1 within 6ε (ε = 2^-24).
    /// With A and B the semi-axes, θ is then off by so little, Δθ, that |sin 2Δθ|·(A² - B²) <= 8ε·2A². In fixed point
    /// 2^-15 takes the place of 6ε and 8ε both, over the whole range.
    ///
    /// # Cost
    /// Two roots, three divisions, 16 multiplications. In fixed point two roots and three divisions of 64 bits.
    fn jacobi_rotation(
        self,
        x: [Self::Number; 2],
        y: [Self::Number; 2],
        scale: [u32; 2],
    ) -> [Self::Number; 2];
    /// `x` less a multiple of 2^`period`: a number above -2^`period` and below 2^`period`. Exact; infinities and NaN
    /// give NaN, and where there is no NaN, any such number.
    fn wrap(self, x: Self::Number, period: u32) -> Self::Number;
    /// x·2^`bits` rounded down, in two's complement, for |x·2^`bits`| < 2^31 and `bits` up to 30. NaN gives a multiple
    /// of 2^31; numbers beyond give any word.
    fn floor_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// The same to the nearest, halves up, for |x·2^`bits`| < 2^30.
    fn round_scaled(self, x: Self::Number, bits: u32) -> Self::U32;
    /// The nearest word from 0 to 255, of halves the upper; 0 for NaN.
    fn nearest_byte(self, x: Self::Number) -> Self::U32;
    /// The nearest word to `greatest` times x, from 0 to `greatest`, which is at most 2^15 - 1; 0 for NaN.
    fn of_unit(self, x: Self::Number, greatest: u16) -> Self::U32;
    /// Words from 0 to 255 as numbers.
    fn to_numbers(self, x: Self::U32) -> Self::Number;
    /// Bits moved up.
    fn shl(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down.
    fn shr(self, x: Self::U32, bits: u32) -> Self::U32;
    /// Bits moved down, the highest staying as it is.
    fn shr_signed(self, x: Self::U32, bits: u32) -> Self::U32;
    /// `(256 - t)·low + t·high` in both halves of each word, which are 0 to 255 before, with t from 0 to 256.
    #[inline(always)]
    fn mix_halves(self, low: Self::U32, high: Self::U32, t: Self::U32) -> Self::U32 {
        // A half of the difference may be negative and borrow from the next. But those of the sum are 0 to 255 * 256,
        // so as a number modulo 2^32 the sum is the two side by side.
        self.shl(low, 8) + (high - low) * t
    }
    /// The lesser of two words.
    fn min_words(self, a: Self::U32, b: Self::U32) -> Self::U32;

    /// Whether a < b; not so where one is NaN.
    fn less(self, a: Self::Number, b: Self::Number) -> Self::Mask;
    /// Whether a = b.
    fn equal_words(self, a: Self::U32, b: Self::U32) -> Self::Mask;
    /// Whether a < b.
    fn less_words(self, a: Self::U32, b: Self::U32) -> Self::Mask;
    /// `a` where the mask is set, elsewhere `b`.
    fn select(self, mask: Self::Mask, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `a` where the mask is set, elsewhere `b`.
    fn select_words(self, mask: Self::Mask, a: Self::U32, b: Self::U32) -> Self::U32;
    /// The mask with these bits, lane 0 the lowest.
    fn mask(self, bits: u32) -> Self::Mask;
    /// The bits of a mask.
    fn bits(self, mask: Self::Mask) -> u32;

    /// `value`, `value + step`, `value + 2 step` and so on.
    fn int_ramp(self, value: i32, step: i32) -> Self::Int;
    /// The same integer for each.
    fn int(self, x: i32) -> Self::Int;
    /// To the nearest number.
    fn int_to_number(self, x: Self::Int) -> Self::Number;
    /// Whether x >= 0.
    fn not_negative(self, x: Self::Int) -> Self::Mask;
    /// `value`, `value + step`, `value + 2 step` and so on.
    fn long_ramp(self, value: i64, step: i64) -> Self::Long;
    /// `x + step` for each.
    fn long_add(self, x: Self::Long, step: i64) -> Self::Long;
    /// To the nearest number.
    fn long_to_number(self, x: Self::Long) -> Self::Number;
}

/// log2(1 + m) is m + m(1 - m)(`LOG2`\[0\] + `LOG2`\[1\] m) within 8.8e-4, exactly so for 0 and 1: the least error that
/// two coefficients reach.
const LOG2: [f32; 2] = [0.422_865_4, -0.159_220_2];

/// Half of log2 of a square in `f32`, by its exponent as it is stored and its mantissa from 1 to 2. At most 64, also if
/// the square is NaN of either sign.
#[inline(always)]
fn half_log2<L: Lanes>(lanes: L, exponent: L::Number, mantissa: L::Number) -> L::Number {
    let one = lanes.splat(1.0);
    let m = mantissa - one;
    let correction = m * (one - m) * (lanes.splat(LOG2[0]) + lanes.splat(LOG2[1]) * m);
    let log2 = exponent - lanes.splat(127.0) + (m + correction);
    lanes.min(lanes.splat(0.5) * log2, lanes.splat(64.0))
}

/// Lanes of `f32`, in which a depth is a number as well.
pub trait Floating: Lanes<Depth = <Self as Lanes>::Number> {
    /// As many lanes as are best for long rows of samples.
    type Wide: Floating;

    /// These lanes on the same machine.
    fn wide(self) -> Self::Wide;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Q16;
    use crate::for_lanes;

    fn length(x: f32, y: f32, scale: [u32; 2]) -> f64 {
        let [a, b] = scale.map(f64::from);
        (f64::from(x) * a).hypot(f64::from(y) * b)
    }

    /// Each lane of the machine's and of its wide lanes does as one lane alone.
    fn alone_and_together<L: Floating>(lanes: L) {
        let mut noise = 1u32;
        let mut next = || {
            noise = noise.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            noise ^ noise >> 13
        };
        let halves = |noise: u32| noise & 0x00ff_00ff;
        for _ in 0..1000 {
            let words = lanes.each(|_| next());
            let [low, high] = [lanes.each(|_| halves(next())), lanes.each(|_| halves(next()))];
            let t = lanes.each(|_| next() % 257);
            let [a, b] = [lanes.load_words(&low), lanes.load_words(&high)];
            let mixed = lanes.store_words(lanes.mix_halves(a, b, lanes.load_words(&t)));
            let gathered = lanes.store_words(lanes.gather(lanes.load_words(&words), |word| word ^ 5));
            let pairs = lanes.gather_pairs(lanes.load_words(&words), |word| [!word, word / 3]);
            let [firsts, seconds] = pairs.map(|words| lanes.store_words(words));
            let equal = lanes.bits(lanes.equal_words(a & lanes.word(1), b & lanes.word(1)));
            let numbers = words.as_ref().iter().map(|&word| f32::from_bits(word));
            for x in numbers.filter(|x| x.is_finite()) {
                let first = |number: L::Number| lanes.store(number).as_ref()[0].to_bits();
                let first_word = |word: L::U32| lanes.store_words(word).as_ref()[0];
                assert_eq!(first(lanes.wrap(lanes.splat(x), 3)), One.wrap(x, 3).to_bits(), "{x:e}");
                if x.abs() < 4_194_304.0 {
                    let found =
                        [lanes.floor_scaled(lanes.splat(x), 8), lanes.round_scaled(lanes.splat(x), 8)];
                    let expected = [One.floor_scaled(x, 8), One.round_scaled(x, 8)];
                    assert_eq!(found.map(first_word), expected.map(|word| word.0), "{x:e}");
                }
            }
            for (k, &word) in words.as_ref().iter().enumerate() {
                let [low, high, t] = [low.as_ref()[k], high.as_ref()[k], t.as_ref()[k]];
                let mean = |shift: u32| {
                    let [low, high] = [low, high].map(|word| word >> shift & 255);
                    ((256 - t) * low + t * high) << shift
                };
                assert_eq!(mixed.as_ref()[k], mean(0) | mean(16));
                let found = [gathered.as_ref()[k], firsts.as_ref()[k], seconds.as_ref()[k]];
                assert_eq!(found, [word ^ 5, !word, word / 3]);
                assert_eq!(equal >> k & 1 == 1, low & 1 == high & 1);
            }
        }
        let [value, step] = [-7i64, 3];
        let ints = lanes.store(lanes.int_to_number(lanes.int_ramp(-7, 3)));
        let longs = lanes.long_add(lanes.long_ramp(value, step), 1 << 40);
        let longs = lanes.store(lanes.long_to_number(longs));
        let ramp = lanes.store(lanes.ramp());
        let bits = lanes.bits(lanes.mask(0xa5c3_a5c3));
        for k in 0..L::COUNT {
            let at = i64::try_from(k).unwrap();
            #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
            let [int, long, number] =
                [step * at + value, step * at + value + (1 << 40), at].map(|x| x as f32);
            assert_eq!([ints.as_ref()[k], longs.as_ref()[k], ramp.as_ref()[k]], [int, long, number]);
            assert_eq!(bits >> k & 1, 0xa5c3_a5c3 >> k & 1);
        }
        assert_eq!(bits >> L::COUNT, 0);
    }

    #[test]
    fn lanes_do_not_mix() {
        alone_and_together(One);
        for machine in Machine::all() {
            for_lanes!(machine, lanes => { alone_and_together(lanes); alone_and_together(lanes.wide()) });
        }
    }

    /// By bits, over the binades of lengths from 2^-63 to 2^63; all kinds of lanes have the same bits.
    #[test]
    fn log2_length_of_floats() {
        let mut worst = 0.0f64;
        let mut noise = 1u32;
        let mut next = || {
            noise = noise.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            noise ^ noise >> 13
        };
        for i in 0..1_000_000u32 {
            // Both components, or one.
            let x = f32::from_bits((127 - 48 + i % 95) << 23 | next() >> 9);
            let y = if i % 3 == 0 { 0.0 } else { -x * f32::from_bits(0x3f80_0000 | next() >> 9) };
            let scale = [1 + next() % 0x4000, 1 + next() % 0x4000];
            let found = One.log2_length(x, y, scale);
            worst = worst.max((f64::from(found) - length(x, y, scale).log2()).abs());
            for machine in Machine::all() {
                let same = for_lanes!(machine, lanes => {
                    lanes.store(lanes.log2_length(lanes.splat(x), lanes.splat(y), scale)).as_ref()[0]
                });
                assert_eq!(same.to_bits(), found.to_bits());
            }
        }
        std::println!("log2 of a length: at most {:.3} of 2^-11 off", worst * 2048.0);
        assert!((0.8..=1.0).contains(&(worst * 2048.0)), "{worst}");
        for exponent in -62..62 {
            let x = 2f32.powi(exponent);
            assert_eq!(f64::from(One.log2_length(x, 0.0, [1, 5])), f64::from(exponent));
            assert_eq!(f64::from(One.log2_length(0.0, -x, [5, 2])), f64::from(exponent + 1));
        }
        let special = |x: f32, y: f32| One.log2_length(x, y, [1, 1]);
        for x in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e30] {
            assert!((special(x, 1.0) - 64.0).abs() <= 0.0 && (special(0.0, x) - 64.0).abs() <= 0.0, "{x}");
        }
        for x in [0.0, -0.0, 1e-45, f32::MIN_POSITIVE, -1e-20] {
            assert!((-63.5..=-63.0).contains(&special(x, 0.0)), "{x}");
        }
    }

    #[test]
    fn log2_length_of_integers() {
        let mut worst = 0.0f64;
        let mut noise = 7u32;
        let mut next = || {
            noise = noise.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            noise ^ noise >> 13
        };
        for i in 0..1_000_000u32 {
            let bits = next().cast_signed() >> (i % 31);
            let (x, y) = (Q16::from_bits(bits), Q16::from_bits(if i % 3 == 0 { 0 } else { bits / 3 }));
            let scale = [1 + next() % 0x4000, 1 + next() % 0x4000];
            let [dx, dy] = [x, y].map(|q| f64::from(q.to_bits()) / 65536.0);
            let length = (dx * f64::from(scale[0])).hypot(dy * f64::from(scale[1]));
            let found = f64::from(OneFixed.log2_length(x, y, scale).to_bits()) / 65536.0;
            if length >= 32768.0 {
                assert!((15.0..=16.0).contains(&found), "{length} {found}");
            } else if length == 0.0 {
                assert!((found + 16.0).abs() <= 0.0);
            } else {
                worst = worst.max((found - length.log2()).abs());
            }
        }
        std::println!("log2 of a length in integers: at most {:.3} of 2^-11 off", worst * 2048.0);
        assert!((0.8..=1.0).contains(&(worst * 2048.0)), "{worst}");
        for exponent in 0..31 {
            let x = Q16::from_bits(1 << exponent);
            assert_eq!(OneFixed.log2_length(x, Q16::ZERO, [1, 1]), Q16::from_bits((exponent - 16) << 16));
        }
    }
}
