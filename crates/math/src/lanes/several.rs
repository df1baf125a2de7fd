//! Several samples at a time, in the vector registers that the machine has.

use super::one::power_of_two;
use super::{Floating, Lanes, half_log2, jacobi, longer_square, scaled_square};
use core::fmt::{Debug, Formatter, Result};
#[cfg(target_arch = "x86_64")]
use fearless_simd::Level;
use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdInt, SimdInto, SimdMask, f32x4, f32x8, f32x16,
    f64x2, f64x4, f64x8, i32x4, i32x8, i32x16, mask32x4, mask32x8, mask32x16, u16x8, u16x16, u16x32, u32x4,
    u32x8, u32x16, u64x2, u64x4, u64x8,
};

/// A type of lanes: its name, their number, and the types of its vectors. Then the numbers of all lanes, of half and of
/// a quarter of them, and the function that makes a vector of fours.
macro_rules! several {
    (
        $(#[$doc:meta])* $name:ident, $count:literal,
        [$f32:ident, $i32:ident, $u32:ident, $u16:ident, $mask:ident, $f64:ident, $u64:ident, $narrow:ident],
        [$($lane:literal)+], [$($half:literal)+], [$($quarter:literal)+], $combine:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name<S: Simd>(
            /// The proof that the machine has them, from `fearless_simd`, see [`Machine`](super::Machine).
            pub S,
        );

        impl<S: Simd> Debug for $name<S> {
            fn fmt(&self, f: &mut Formatter<'_>) -> Result {
                f.debug_tuple(stringify!($name)).field(&self.0).finish()
            }
        }

        impl<S: Simd> $name<S> {
            /// 0, 1, 2 and so on in `f64`, for half of the lanes.
            #[inline(always)]
            fn half(self) -> $f64<S> {
                [$(f64::from($half)),+].simd_into(self.0)
            }

            /// The nearest integers from 0 to `greatest`.
            #[inline(always)]
            fn nearest(self, x: $f32<S>, greatest: f32) -> $u32<S> {
                let rounded = self.max(x + self.splat(0.5), self.splat(0.0));
                self.min(rounded, self.splat(greatest)).to_int::<$i32<S>>().bitcast()
            }

            /// Half of the logarithm of a square.
            #[inline(always)]
            fn half_log2(self, square: $f32<S>) -> $f32<S> {
                let bits = square.bitcast::<$u32<S>>();
                let mantissa = (bits & self.word(0x007f_ffff) | self.word(0x3f80_0000)).bitcast();
                half_log2(self, self.to_numbers(bits >> 23), mantissa)
            }

            /// Without the fraction, and at times without the sign of zero. SSE2 has no instruction for it, and a call
            /// costs all registers; from 2^23 on there is no fraction.
            #[inline(always)]
            fn trunc(self, x: $f32<S>) -> $f32<S> {
                #[cfg(target_arch = "x86_64")]
                if let Level::Sse2(_) = self.0.level() {
                    let whole = x.to_int::<$i32<S>>().to_float::<$f32<S>>();
                    return x.abs().simd_lt(self.splat(8_388_608.0)).select(whole, x);
                }
                x.trunc()
            }

            /// The greatest integer that is not above.
            #[inline(always)]
            fn floor(self, x: $f32<S>) -> $f32<S> {
                #[cfg(target_arch = "x86_64")]
                if let Level::Sse2(_) = self.0.level() {
                    let whole = self.trunc(x);
                    return whole - x.simd_lt(whole).select(self.splat(1.0), self.splat(0.0));
                }
                x.floor()
            }
        }

        impl<S: Simd> Lanes for $name<S> {
            const COUNT: usize = $count;
            const FIXED: bool = false;
            type Number = $f32<S>;
            type Depth = $f32<S>;
            type U32 = $u32<S>;
            type Int = $i32<S>;
            /// In `f64`, which holds these integers exactly and rounds to `f32` as an integer does.
            type Long = [$f64<S>; 2];
            type Mask = $mask<S>;
            type Each<T: Copy> = [T; $count];

            #[inline(always)]
            fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
                self.0.vectorize(f)
            }

            #[cfg_attr(target_arch = "wasm32", inline(never))]
            #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
            fn apart<R>(self, f: impl FnOnce() -> R) -> R {
                f()
            }

            #[inline(always)]
            fn groups<T: Copy>(slice: &mut [T]) -> (&mut [[T; $count]], &mut [T]) {
                slice.as_chunks_mut()
            }

            #[inline(always)]
            fn each<T: Copy>(self, mut f: impl FnMut(usize) -> T) -> [T; $count] {
                [$(f($lane)),+]
            }

            #[inline(always)]
            fn splat(self, x: f32) -> $f32<S> {
                $f32::splat(self.0, x)
            }

            #[inline(always)]
            fn word(self, x: u32) -> $u32<S> {
                $u32::splat(self.0, x)
            }

            #[inline(always)]
            fn ramp(self) -> $f32<S> {
                [$(f32::from($lane as u8)),+].simd_into(self.0)
            }

            #[inline(always)]
            fn load(self, values: &[f32; $count]) -> $f32<S> {
                (*values).simd_into(self.0)
            }

            #[inline(always)]
            fn store(self, values: $f32<S>) -> [f32; $count] {
                values.into()
            }

            // As words, because compilers make a masked store of a selection of numbers, which is slow on some
            // machines, and from which no later load is served before it has reached memory.
            #[inline(always)]
            fn copy_where(self, mask: $mask<S>, values: &[f32; $count], to: &mut [f32; $count]) {
                let (new, kept): ($u32<S>, $u32<S>) = (self.load(values).bitcast(), self.load(to).bitcast());
                *to = self.store(mask.select(new, kept).bitcast());
            }

            #[inline(always)]
            fn less_in_memory(self, a: &[f32; $count], b: &[f32; $count]) -> $mask<S> {
                self.load(a).simd_lt(self.load(b))
            }

            #[inline(always)]
            fn each_depth<T: Copy>(self, depth: $f32<S>, number: impl Fn(f32) -> T, _: impl Fn(u32) -> T) -> [T; $count] {
                let d = self.store(depth);
                [$(number(d[$lane])),+]
            }

            // In fours, so that all loads come before the first of them takes its place.
            #[inline(always)]
            fn gather(self, indices: $u32<S>, mut word: impl FnMut(u32) -> u32) -> $u32<S> {
                let indices: [u32; $count] = indices.into();
                let mut four = |at: usize| -> u32x4<S> {
                    let mut word = |k: usize| word(indices[at + k]);
                    [word(0), word(1), word(2), word(3)].simd_into(self.0)
                };
                $combine([$(four(4 * $quarter)),+])
            }

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "a half at a time")]
            fn gather_pairs(self, indices: $u32<S>, mut words: impl FnMut(u32) -> [u32; 2]) -> [$u32<S>; 2] {
                let pairs: [u64; $count / 2] = indices.bitcast::<$u64<S>>().into();
                let mut found = |index: u64| {
                    let [low, high] = words(index as u32);
                    u64::from(high) << 32 | u64::from(low)
                };
                let low: $u64<S> = [$(found(pairs[$quarter]), found(pairs[$quarter] >> 32)),+].simd_into(self.0);
                let pairs = &pairs[$count / 4..];
                let high: $u64<S> = [$(found(pairs[$quarter]), found(pairs[$quarter] >> 32)),+].simd_into(self.0);
                let (low, high) = low.bitcast::<$u32<S>>().deinterleave(high.bitcast::<$u32<S>>());
                [low, high]
            }

            #[inline(always)]
            fn load_words(self, values: &[u32; $count]) -> $u32<S> {
                (*values).simd_into(self.0)
            }

            #[inline(always)]
            fn store_words(self, values: $u32<S>) -> [u32; $count] {
                values.into()
            }

            // Only x86's instructions choose the second of two equal ones; what others do with zeros of both signs is
            // theirs.
            #[inline(always)]
            fn min(self, a: $f32<S>, b: $f32<S>) -> $f32<S> {
                if cfg!(target_arch = "x86_64") { a.min(b) } else { a.simd_lt(b).select(a, b) }
            }

            #[inline(always)]
            fn max(self, a: $f32<S>, b: $f32<S>) -> $f32<S> {
                if cfg!(target_arch = "x86_64") { a.max(b) } else { a.simd_gt(b).select(a, b) }
            }

            #[inline(always)]
            fn sqrt(self, x: $f32<S>) -> $f32<S> {
                x.sqrt()
            }

            #[inline(always)]
            fn log2_length(self, x: $f32<S>, y: $f32<S>, scale: [u32; 2]) -> $f32<S> {
                self.half_log2(scaled_square(self, [x, y], scale))
            }

            #[inline(always)]
            fn log2_longer(self, vectors: [[$f32<S>; 2]; 2], scale: [u32; 2]) -> $f32<S> {
                self.half_log2(longer_square(self, vectors, scale))
            }

            #[inline(always)]
            fn jacobi_rotation(self, x: [$f32<S>; 2], y: [$f32<S>; 2], scale: [u32; 2]) -> [$f32<S>; 2] {
                jacobi::floating(self, x, y, scale)
            }

            #[inline(always)]
            fn wrap(self, x: $f32<S>, period: u32) -> $f32<S> {
                let periods = x * self.splat(1.0 / power_of_two(period));
                (periods - self.trunc(periods)) * self.splat(power_of_two(period))
            }

            #[inline(always)]
            fn floor_scaled(self, x: $f32<S>, bits: u32) -> $u32<S> {
                self.floor(x * self.splat(power_of_two(bits))).to_int::<$i32<S>>().bitcast()
            }

            // From 2^31 on, where x86's conversion says -2^31, all numbers are multiples of 2^8.
            #[inline(always)]
            fn floor_fraction_scaled(self, x: $f32<S>, bits: u32) -> $u32<S> {
                let whole = cfg!(target_arch = "x86_64") && bits <= 8;
                self.floor_scaled(if whole { x } else { self.wrap(x, 0) }, bits)
            }

            #[inline(always)]
            fn round_scaled(self, x: $f32<S>, bits: u32) -> $u32<S> {
                // The halves below it: an odd one rounds up.
                self.shr_signed(self.floor_scaled(x, bits + 1) + self.word(1), 1)
            }

            #[inline(always)]
            fn nearest_byte(self, x: $f32<S>) -> $u32<S> {
                self.nearest(x, 255.0)
            }

            #[inline(always)]
            fn of_unit(self, x: $f32<S>, greatest: u16) -> $u32<S> {
                let greatest = f32::from(greatest);
                self.nearest(x * self.splat(greatest), greatest)
            }

            #[inline(always)]
            fn to_numbers(self, x: $u32<S>) -> $f32<S> {
                self.int_to_number(x.bitcast())
            }

            #[inline(always)]
            fn shl(self, x: $u32<S>, bits: u32) -> $u32<S> {
                x << bits
            }

            #[inline(always)]
            fn shr(self, x: $u32<S>, bits: u32) -> $u32<S> {
                x >> bits
            }

            #[inline(always)]
            fn shr_signed(self, x: $u32<S>, bits: u32) -> $u32<S> {
                (x.bitcast::<$i32<S>>() >> bits).bitcast()
            }

            #[inline(always)]
            fn mix_halves(self, low: $u32<S>, high: $u32<S>, t: $u32<S>) -> $u32<S> {
                let t = (t | t << 16).bitcast::<$u16<S>>();
                let [low, high] = [low.bitcast::<$u16<S>>(), high.bitcast()];
                ((low << 8) + (high - low) * t).bitcast()
            }

            #[inline(always)]
            fn min_words(self, a: $u32<S>, b: $u32<S>) -> $u32<S> {
                a.min(b)
            }

            #[inline(always)]
            fn less(self, a: $f32<S>, b: $f32<S>) -> $mask<S> {
                a.simd_lt(b)
            }

            #[inline(always)]
            fn equal_words(self, a: $u32<S>, b: $u32<S>) -> $mask<S> {
                a.simd_eq(b)
            }

            #[inline(always)]
            fn less_words(self, a: $u32<S>, b: $u32<S>) -> $mask<S> {
                a.simd_lt(b)
            }

            #[inline(always)]
            fn select(self, mask: $mask<S>, a: $f32<S>, b: $f32<S>) -> $f32<S> {
                mask.select(a, b)
            }

            #[inline(always)]
            fn select_words(self, mask: $mask<S>, a: $u32<S>, b: $u32<S>) -> $u32<S> {
                mask.select(a, b)
            }

            #[inline(always)]
            fn mask(self, bits: u32) -> $mask<S> {
                $mask::from_bitmask(self.0, u64::from(bits))
            }

            #[inline(always)]
            fn bits(self, mask: $mask<S>) -> u32 {
                #[expect(clippy::cast_possible_truncation, reason = "eight bits")]
                let bits = mask.to_bitmask() as u32;
                bits
            }

            #[inline(always)]
            fn int_ramp(self, value: i32, step: i32) -> $i32<S> {
                let steps: $i32<S> = [$($lane),+].simd_into(self.0);
                self.int(value) + steps * self.int(step)
            }

            #[inline(always)]
            fn int(self, x: i32) -> $i32<S> {
                $i32::splat(self.0, x)
            }

            #[inline(always)]
            fn int_to_number(self, x: $i32<S>) -> $f32<S> {
                x.to_float::<$f32<S>>()
            }

            #[inline(always)]
            fn not_negative(self, x: $i32<S>) -> $mask<S> {
                x.simd_gt(self.int(-1))
            }

            #[inline(always)]
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            fn long_ramp(self, value: i64, step: i64) -> [$f64<S>; 2] {
                let step = $f64::splat(self.0, step as f64);
                let low = $f64::splat(self.0, value as f64) + step * self.half();
                [low, low + step * $f64::splat(self.0, f64::from($count / 2))]
            }

            #[inline(always)]
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            fn long_add(self, x: [$f64<S>; 2], step: i64) -> [$f64<S>; 2] {
                let step = $f64::splat(self.0, step as f64);
                [x[0] + step, x[1] + step]
            }

            #[inline(always)]
            fn long_to_number(self, x: [$f64<S>; 2]) -> $f32<S> {
                self.0.$narrow(x[0], x[1])
            }

            // The sum with 1.5·2^(52 + bits) rounds to a multiple of 2^bits.
            #[inline(always)]
            #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
            fn long_parts(self, step: i64, bits: u32) -> [$f32<S>; 2] {
                let align = $f64::splat(self.0, f64::from_bits((u64::from(1075 + bits) << 52) | (1 << 51)));
                let step = $f64::splat(self.0, step as f64);
                let low = step * self.half();
                let high = low + step * $f64::splat(self.0, f64::from($count / 2));
                let [a, b] = [(low + align) - align, (high + align) - align];
                [self.0.$narrow(a, b), self.0.$narrow(low - a, high - b)]
            }
        }
    };
}

several! {
    /// Four samples at a time, on a machine with the instructions `S`, in one register of 128 bits.
    Four, 4,
    [f32x4, i32x4, u32x4, u16x8, mask32x4, f64x2, u64x2, narrow_f64x2],
    [0 1 2 3], [0 1], [0], of_one
}

several! {
    /// Eight samples at a time, on a machine with the instructions `S`: in one register of 256 bits, or pairs of 128.
    Eight, 8,
    [f32x8, i32x8, u32x8, u16x16, mask32x8, f64x4, u64x4, narrow_f64x4],
    [0 1 2 3 4 5 6 7], [0 1 2 3], [0 1], of_two
}

several! {
    /// Sixteen samples at a time: in one register of 512 bits, or several smaller ones, which do not wait for each
    /// other.
    Sixteen, 16,
    [f32x16, i32x16, u32x16, u16x32, mask32x16, f64x8, u64x8, narrow_f64x8],
    [0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15], [0 1 2 3 4 5 6 7], [0 1 2 3], of_four
}

/// The samples that are best in long rows. SSE2, Neon and WebAssembly take pairs for eight, and have no more.
macro_rules! floating {
    ($($lanes:ident<$machine:ident>: $wide:ident),+) => {
        $(
            impl Floating for $lanes<fearless_simd::$machine> {
                type Wide = $wide<fearless_simd::$machine>;

                #[inline(always)]
                fn wide(self) -> Self::Wide {
                    $wide(self.0)
                }
            }
        )+
    };
}

#[cfg(all(target_arch = "x86_64", feature = "avx512"))]
floating!(Eight<Avx512>: Sixteen, Sixteen<Avx512>: Sixteen);
#[cfg(target_arch = "x86_64")]
floating!(Eight<Avx2>: Sixteen, Sixteen<Avx2>: Sixteen, Eight<Sse2>: Eight, Four<Sse2>: Four);
#[cfg(target_arch = "aarch64")]
floating!(Eight<Neon>: Eight);
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
floating!(Four<WasmSimd128>: Four);

/// A vector of one part.
#[inline(always)]
fn of_one<S: Simd>([a]: [u32x4<S>; 1]) -> u32x4<S> {
    a
}

/// A vector of these parts, in order.
#[inline(always)]
fn of_two<S: Simd>([a, b]: [u32x4<S>; 2]) -> u32x8<S> {
    a.combine(b)
}

/// A vector of these parts, in order.
#[inline(always)]
fn of_four<S: Simd>([a, b, c, d]: [u32x4<S>; 4]) -> u32x16<S> {
    a.combine(b).combine(c.combine(d))
}
