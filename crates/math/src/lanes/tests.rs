//! One lane alone against lanes together, and the promises of both against `f64`.

use super::*;
use crate::Q16;
use crate::for_lanes;
use core::num::Wrapping;

fn length(x: f32, y: f32, scale: [u32; 2]) -> f64 {
    let [a, b] = scale.map(f64::from);
    (f64::from(x) * a).hypot(f64::from(y) * b)
}

/// Numbers and words of all kinds: small ones, equal ones, both zeros, halves, and noise.
struct Noise(u32);

impl Noise {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let noise = self.0 ^ self.0 >> 13;
        if noise >> 28 == 0 { noise & 3 } else { noise }
    }

    /// A number that is finite.
    fn number(&mut self) -> f32 {
        let [noise, kind] = [self.word(), self.word() >> 29];
        #[expect(clippy::cast_precision_loss, reason = "any number")]
        let halves = (noise & 255) as f32 * 0.5 - 64.0;
        let any = f32::from_bits(noise & !(1 << 30) | u32::from(noise & 1 << 29 == 0) << 30);
        match kind {
            0 => halves,
            1 => -0.0,
            2 => f32::from_bits(noise & 0x807f_ffff | 0x3f00_0000),
            _ if any.is_finite() => any,
            _ => 1e30,
        }
    }
}

/// All lanes of `lanes` do to numbers, words and masks as one lane alone: every operation, on random ones, by bits.
fn together_as_alone<L: Floating>(lanes: L) {
    let mut noise = Noise(1);
    for round in 0..3000 {
        let [a, b] = [lanes.each(|_| noise.number()), lanes.each(|_| noise.number())];
        let [v, w] = [lanes.each(|_| noise.word()), lanes.each(|_| noise.word())];
        let [p, q, r, s] = [lanes.load(&a), lanes.load(&b), lanes.splat(3.0), lanes.ramp()];
        let [x, y] = [lanes.load_words(&v), lanes.load_words(&w)];
        let bits = noise.word() & ((1 << L::COUNT) - 1);
        let mask = lanes.mask(bits);
        assert_eq!(lanes.bits(mask), bits);
        for k in 0..L::COUNT {
            let [a, b] = [a.as_ref()[k], b.as_ref()[k]];
            let [v, w] = [v.as_ref()[k], w.as_ref()[k]].map(Wrapping);
            #[expect(clippy::cast_precision_loss, reason = "a lane's number")]
            let (ramp, set) = (k as f32, bits >> k & 1 == 1);
            macro_rules! same_number {
                ($several:expr, $one:expr) => {{
                    let [one, several]: [f32; 2] = [$one, lanes.store($several).as_ref()[k]];
                    let alike = one.to_bits() == several.to_bits() || one.is_nan() && several.is_nan();
                    assert!(alike, "{}: {several:e}, not {one:e}, of {a:e}, {b:e}", stringify!($several));
                }};
            }
            macro_rules! same_word {
                ($several:expr, $one:expr) => {{
                    let [one, several]: [u32; 2] = [$one.0, lanes.store_words($several).as_ref()[k]];
                    let text = stringify!($several);
                    assert!(
                        one == several,
                        "{text}: {several:x}, not {one:x}, of {a:e}, {b:e}, {v:x}, {w:x}"
                    );
                }};
            }
            macro_rules! same_truth {
                ($several:expr, $one:expr) => {
                    let text = stringify!($several);
                    assert!((lanes.bits($several) >> k & 1 == 1) == $one, "{text} of {a:e}, {b:e}, {v}, {w}");
                };
            }
            same_number!(p + q, a + b);
            same_number!(p - q, a - b);
            same_number!(p * q, a * b);
            same_number!(p / q, a / b);
            same_number!(-p, -a);
            same_number!(s * r, ramp * 3.0);
            same_number!(lanes.sqrt(p), One.sqrt(a));
            // Without the sign of zero, which is either one.
            let zero = lanes.splat(0.0);
            same_number!(lanes.wrap(p, round % 9) + zero, One.wrap(a, round % 9) + 0.0);
            same_number!(lanes.select(mask, p, q), if set { a } else { b });
            same_number!(lanes.to_numbers(x & lanes.word(255)), One.to_numbers(v & Wrapping(255)));
            same_number!(lanes.log2_length(p, q, [3, 5]), One.log2_length(a, b, [3, 5]));
            same_number!(
                lanes.log2_longer([[p, q], [q, s]], [3, 5]),
                One.log2_longer([[a, b], [b, ramp]], [3, 5])
            );
            let [across, down] = [One.log2_length(a, b, [3, 5]), One.log2_length(b, ramp, [3, 5])];
            same_number!(lanes.log2_longer([[p, q], [q, s]], [3, 5]), across.max(down));
            // Of zeros with both signs either one.
            if a != b {
                same_number!(lanes.min(p, q), One.min(a, b));
                same_number!(lanes.max(p, q), One.max(a, b));
            }
            same_word!(x + y, v + w);
            same_word!(x - y, v - w);
            same_word!(x * y, v * w);
            same_word!(x & y, v & w);
            same_word!(x | y, v | w);
            same_word!(x ^ y, v ^ w);
            same_word!(lanes.shl(x, round & 31), One.shl(v, round & 31));
            same_word!(lanes.shr(x, round & 31), One.shr(v, round & 31));
            same_word!(lanes.shr_signed(x, round & 31), One.shr_signed(v, round & 31));
            same_word!(lanes.min_words(x, y), One.min_words(v, w));
            same_word!(lanes.select_words(mask, x, y), if set { v } else { w });
            same_word!(lanes.nearest_byte(p), One.nearest_byte(a));
            same_word!(lanes.nearest_byte(p * r), One.nearest_byte(a * 3.0));
            same_word!(lanes.of_unit(p, 999), One.of_unit(a, 999));
            if a.abs() < 4_194_304.0 {
                same_word!(lanes.floor_scaled(p, 8), One.floor_scaled(a, 8));
                same_word!(lanes.round_scaled(p, 8), One.round_scaled(a, 8));
            }
            let ones = (1 << (round % 15)) - 1;
            let (found, expected) =
                (lanes.floor_fraction_scaled(p, round % 15), One.floor_fraction_scaled(a, round % 15));
            same_word!(found & lanes.word(ones), expected & Wrapping(ones));
            same_truth!(lanes.less(p, q), a < b);
            same_truth!(lanes.less_words(x, y), v < w);
            same_truth!(lanes.equal_words(x, y), v == w);
            same_truth!(mask & lanes.less(p, q), set && a < b);
            same_truth!(mask | lanes.less(p, q), set || a < b);
            same_truth!(!mask, !set);
        }
        let mut kept = b;
        lanes.copy_where(mask, &a, &mut kept);
        let less = lanes.bits(lanes.less_in_memory(&a, &b));
        for (k, kept) in kept.as_ref().iter().enumerate() {
            let [a, b] = [a.as_ref()[k], b.as_ref()[k]];
            assert_eq!(kept.to_bits(), if bits >> k & 1 == 1 { a } else { b }.to_bits());
            assert_eq!(less >> k & 1 == 1, a < b);
        }
    }
}

/// Words that are found by others, means of bytes, and sequences.
fn found_and_counted<L: Floating>(lanes: L) {
    let mut noise = Noise(7);
    let halves = |word: u32| word & 0x00ff_00ff;
    for _ in 0..1000 {
        let words = lanes.each(|_| noise.word());
        let [low, high] = [lanes.each(|_| halves(noise.word())), lanes.each(|_| halves(noise.word()))];
        let t = lanes.each(|_| noise.word() % 257);
        let [a, b] = [lanes.load_words(&low), lanes.load_words(&high)];
        let mixed = lanes.store_words(lanes.mix_halves(a, b, lanes.load_words(&t)));
        let gathered = lanes.store_words(lanes.gather(lanes.load_words(&words), |word| word ^ 5));
        let pairs = lanes.gather_pairs(lanes.load_words(&words), |word| [!word, word / 3]);
        let [firsts, seconds] = pairs.map(|words| lanes.store_words(words));
        for (k, &word) in words.as_ref().iter().enumerate() {
            let [low, high, t] = [low.as_ref()[k], high.as_ref()[k], t.as_ref()[k]];
            let mean = |shift: u32| {
                let [low, high] = [low, high].map(|word| word >> shift & 255);
                ((256 - t) * low + t * high) << shift
            };
            assert_eq!(mixed.as_ref()[k], mean(0) | mean(16));
            let found = [gathered.as_ref()[k], firsts.as_ref()[k], seconds.as_ref()[k]];
            assert_eq!(found, [word ^ 5, !word, word / 3]);
        }
    }
    let [value, step] = [-7i64, 3];
    let ints = lanes.int_ramp(-7, 3);
    let positive = lanes.bits(lanes.not_negative(ints + lanes.int(1)));
    let either = lanes.bits(lanes.not_negative(ints | lanes.int(-1)));
    let ints = lanes.store(lanes.int_to_number(ints));
    let longs = lanes.long_add(lanes.long_ramp(value, step), 1 << 40);
    let longs = lanes.store(lanes.long_to_number(longs));
    for k in 0..L::COUNT {
        let at = i64::try_from(k).unwrap();
        #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
        let [int, long] = [step * at + value, step * at + value + (1 << 40)].map(|x| x as f32);
        assert_eq!([ints.as_ref()[k], longs.as_ref()[k]], [int, long]);
        assert_eq!(positive >> k & 1 == 1, step * at + value + 1 >= 0);
    }
    assert_eq!(either, 0);
}

/// The machine's lanes, and its wide ones.
#[test]
fn lanes_do_not_mix() {
    together_as_alone(One);
    found_and_counted(One);
    for machine in Machine::all() {
        std::println!("{machine:?}");
        for_lanes!(machine, lanes => {
            together_as_alone(lanes);
            together_as_alone(lanes.wide());
            found_and_counted(lanes);
            found_and_counted(lanes.wide());
        });
    }
}

/// The lanes of WebAssembly, by the registers of this machine.
#[test]
#[cfg(all(feature = "simd", target_arch = "x86_64"))]
fn four_lanes_do_not_mix() {
    let lanes = Four(fearless_simd::Level::baseline().as_sse2().unwrap());
    together_as_alone(lanes);
    found_and_counted(lanes);
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

/// So the logarithm of the greater square is the greater logarithm. Over the mantissas of an exponent whose number is
/// 0, and to the next; other exponents are added and rounded, which keeps the order.
#[test]
fn log2_of_squares_is_monotone() {
    let of = |bits: u32| {
        let mantissa = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000);
        super::half_log2(One, One.to_numbers(Wrapping(bits >> 23)), mantissa)
    };
    let one = 1f32.to_bits();
    for bits in one..=2f32.to_bits() {
        assert!(of(bits) <= of(bits + 1), "{bits:x}");
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
            assert!((15.0 - 1.0 / 2048.0..=16.0).contains(&found), "{length} {found}");
        } else if length == 0.0 {
            assert!((found + 16.0).abs() <= 0.0);
        } else {
            worst = worst.max((found - length.log2()).abs());
        }
    }
    std::println!("log2 of a length in integers: at most {:.3} of 2^-11 off", worst * 2048.0);
    assert!((0.8..=1.1).contains(&(worst * 2048.0)), "{worst}");
    for exponent in 0..31 {
        let x = Q16::from_bits(1 << exponent);
        assert_eq!(OneFixed.log2_length(x, Q16::ZERO, [1, 1]), Q16::from_bits((exponent - 16) << 16));
    }
}
