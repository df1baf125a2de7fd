//! Filters of texels as they are stored: for small cores, whose displays have such pixels too.

use alberti_math::lanes::Lanes;
use alberti_math::map2;

use crate::format::{Rgb565, TexelFormat};
use crate::minify::{among_levels, each_word};
use crate::{Bilinear, Gradient, MipSampler, Mipmap, Sampler, Size, Texture, Trilinear, Wrap};

/// A format of RGB565 texels, each by itself or with another, which can be mixed as they are stored, by weights of 5
/// bits.
pub trait Packed: TexelFormat {
    /// Whether a texel has with it the one to its right, which is the first of the row for the last.
    const PAIRS: bool = false;

    /// The word of a texel.
    fn word(texel: Self::Texel) -> u32;

    /// The texel of a word, its channels [apart](Rgb565::spread).
    #[inline(always)]
    fn texel<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        Rgb565::spread(lanes, word)
    }

    /// The one to its right, in [`PAIRS`](Self::PAIRS).
    #[inline(always)]
    fn next<L: Lanes>(lanes: L, word: L::U32) -> L::U32 {
        Self::texel(lanes, word)
    }
}

impl Packed for Rgb565 {
    #[inline(always)]
    fn word(texel: u16) -> u32 {
        texel.into()
    }
}

/// Green, red and blue with room above each for a product with 32.
pub(crate) const SPREAD: u32 = 0x07e0_f81f;
/// A half of 32 in each.
const HALVES: u32 = 16 << 21 | 16 << 11 | 16;

/// Texels in words, of which the channels are apart: green in the upper half, red and blue in the lower.
impl Rgb565 {
    /// The texel in the low bits of a word, its channels apart.
    #[inline(always)]
    pub fn spread<L: Lanes>(lanes: L, texel: L::U32) -> L::U32 {
        (texel | lanes.shl(texel, 16)) & lanes.word(SPREAD)
    }

    /// The nearest to the mean of two, of which the second has a share of so many 32nds.
    #[inline(always)]
    pub fn blended<L: Lanes>(lanes: L, first: L::U32, second: L::U32, share: L::U32) -> L::U32 {
        // The fields of the sum are none below 0; differences that are borrow from the next, and pay it back.
        let sum = lanes.shl(first, 5) + (second - first) * share + lanes.word(HALVES);
        lanes.shr(sum, 5) & lanes.word(SPREAD)
    }

    /// The nearest to the mean of four, by the ways in 32nds from the first to the second and to the third. The last
    /// number is the share of the fourth, about their product.
    #[inline(always)]
    fn mean_of_four<L: Lanes>(
        lanes: L,
        [[a, b], [c, d]]: [[L::U32; 2]; 2],
        [along, up, both]: [L::U32; 3],
    ) -> L::U32 {
        // Shares of all are whole 32nds, none below 0, that add up to 32.
        let step = b - a;
        let sum = lanes.word(HALVES) + lanes.shl(a, 5) + step * along + (c - a) * up + (d - c - step) * both;
        lanes.shr(sum, 5) & lanes.word(SPREAD)
    }

    /// The texel of a word of channels apart.
    #[inline(always)]
    pub fn gathered<L: Lanes>(lanes: L, spread: L::U32) -> L::U32 {
        if L::FIXED {
            // A product, as compilers would make two masks of one for a sum.
            lanes.shr(spread * lanes.word(0x1_0001), 16)
        } else {
            (spread | lanes.shr(spread, 16)) & lanes.word(0xffff)
        }
    }
}

/// The mean of the four texels about a place, channels apart.
#[inline(always)]
pub(crate) fn bilinear<L: Lanes, F: Packed, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    texture: &Texture<'_, F, Z>,
    wrap: (U, V),
    uv: [L::Number; 2],
) -> L::U32 {
    let [[left, right, along], [low, high, up]] = texture.between_by(lanes, uv, wrap, 5);
    let last = lanes.word(texture.height().wrapping_sub(1));
    let low = last - low;
    // Rows are in memory from the top.
    let high = if const { V::PERIODIC } {
        wrap.1.fold(lanes, low - lanes.word(1), texture.height())
    } else {
        last - high
    };
    let [low, high] = map2(
        [low, high],
        #[inline(always)]
        |row| {
            let word = |texel: Option<&F::Texel>| texel.map_or(0, |texel| F::word(*texel));
            if const { F::PAIRS && U::PERIODIC } {
                let pair = texture.words(lanes, row, left, word);
                return [F::texel(lanes, pair), F::next(lanes, pair)];
            }
            let [pair] = texture.word_pairs(lanes, row, [left, right], word);
            map2(pair, |word| F::texel(lanes, word))
        },
    );
    let both = lanes.shr(along * up + lanes.word(16), 5);
    Rgb565::mean_of_four(lanes, [low, high], [along, up, both])
}

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> Sampler<'_, F, Bilinear, U, V, Z> {
    /// The texels' mean as such a texel, without a way over colours of 8 bits a channel; a border is black.
    ///
    /// # Precision
    /// A share of an axis is off by up to 1/64, the product of both by 1/64 more, and there is one rounding to a level.
    /// So a channel is within 2.6 levels of the mean in reals, and green, which has twice as many, within 4.8.
    /// The most that was measured is 1.5 and 2.2. Equal texels give that texel, and a texel's centre gives it.
    ///
    /// # Cost
    /// Four texels, or two pairs, and four products of 32 bits.
    #[inline(always)]
    pub fn packed_lanes<L: Lanes>(&self, lanes: L, u: L::Number, v: L::Number) -> L::U32 {
        Rgb565::gathered(lanes, bilinear(lanes, &self.texture(), self.wraps(), [u, v]))
    }
}

impl<F: Packed, U: Wrap, V: Wrap, Z: Size> MipSampler<'_, F, Trilinear, U, V, Z> {
    /// The mean of both levels as a texel, without a way over colours of 8 bits a channel; a border is black.
    ///
    /// # Precision
    /// As [`Sampler::packed_lanes`], with a weight and a rounding more: within 3.6 levels, green 6.3; 1.6 and 2.5 are
    /// the most that was measured.
    ///
    /// # Cost
    /// Eight texels, or four pairs, and nine products of 32 bits; half of that where a whole level is asked for.
    #[inline(always)]
    pub fn packed_grad_lanes<L: Lanes>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        gradient: &Gradient<[L::Number; 2]>,
    ) -> L::U32 {
        let mipmap = self.mipmap();
        let lambda = gradient.lod_lanes(lanes, mipmap.size());
        let position = lanes.round_scaled(among_levels(lanes, mipmap, lambda), 5);
        let along = position & lanes.word(31);
        let [spread] = each_word(
            lanes,
            lanes.shr(position, 5),
            #[inline(always)]
            |level| [between::<L, F, Z, U, V>(lanes, mipmap, self.wraps(), uv, (level as usize, along))],
        );
        Rgb565::gathered(lanes, spread)
    }
}

/// The mean of a level and the next.
#[inline(always)]
fn between<L: Lanes, F: Packed, Z: Size, U: Wrap, V: Wrap>(
    lanes: L,
    mipmap: &Mipmap<'_, F, Z>,
    wrap: (U, V),
    uv: [L::Number; 2],
    (level, along): (usize, L::U32),
) -> L::U32 {
    let near = bilinear(lanes, &mipmap.level(level), wrap, uv);
    let none = lanes.bits(lanes.equal_words(along, lanes.word(0))) == (1 << L::COUNT) - 1;
    if none {
        return near;
    }
    Rgb565::blended(lanes, near, bilinear(lanes, &mipmap.level(level + 1), wrap, uv), along)
}

#[cfg(test)]
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "small numbers"
)]
mod tests {
    use super::*;
    use crate::format::Rgb565Pairs;
    use crate::{Border, Clamp, Mirror, Repeat};
    use alberti_math::lanes::{One, OneFixed};
    use alberti_math::{Q16, Rgba8};
    use std::vec::Vec;

    const SIDE: u32 = 16;

    fn texels() -> Vec<u16> {
        let mut texels: Vec<u16> =
            (0..SIDE * SIDE).map(|k| (k.wrapping_mul(0x9e37_79b1) >> 15) as u16).collect();
        texels.resize(crate::mipmap::texel_count(SIDE, SIDE), 0);
        crate::mipmap::build(Rgb565, &mut texels, SIDE, SIDE).expect("a texture");
        texels
    }

    fn levels(texel: u32) -> [f64; 3] {
        [texel >> 11, texel >> 5 & 63, texel & 31].map(f64::from)
    }

    /// The mean in reals of a level, by the places of texels' centres.
    fn exact(texels: &[u16], side: usize, [u, v]: [f64; 2]) -> [f64; 3] {
        let size = side as f64;
        let ([x, y], last) = ([u * size - 0.5, v * size - 0.5], side as i64);
        let ([i, j], [s, t]) = ([x.floor(), y.floor()], [x - x.floor(), y - y.floor()]);
        let at = |i: f64, j: f64| {
            let [i, j] = [i, j].map(|k| (k as i64).rem_euclid(last) as usize);
            levels(texels[(side - 1 - j) * side + i].into())
        };
        let [a, b, c, d] = [at(i, j), at(i + 1.0, j), at(i, j + 1.0), at(i + 1.0, j + 1.0)];
        [0, 1, 2].map(|k| (a[k] * (1.0 - s) + b[k] * s) * (1.0 - t) + (c[k] * (1.0 - s) + d[k] * s) * t)
    }

    #[test]
    fn means_are_as_near_as_they_say() {
        let texels = texels();
        let texture = Texture::new(Rgb565, &texels[..(SIDE * SIDE) as usize], SIDE, SIDE).expect("a texture");
        let texture = texture.power_of_two().expect("a power of two");
        let mipmap =
            Mipmap::new(Rgb565, &texels, SIDE, SIDE).expect("levels").power_of_two().expect("a power of two");
        let mut worst = [[0.0_f64; 3]; 2];
        for k in 0..60_000_u32 {
            let [u, v] = [k.wrapping_mul(0x9e37_79b1), k.wrapping_mul(0x85eb_ca77)]
                .map(|x| (x >> 14) as f32 / 65536.0);
            let fixed = [u, v].map(Q16::from_f32);
            let place = [f64::from(u), f64::from(v)];
            let right = exact(&texels, SIDE as usize, place);
            let sampler = texture.sampler(Bilinear, Repeat);
            let found = sampler.packed_lanes(One, u, v).0;
            assert_eq!(sampler.packed_lanes(OneFixed, fixed[0], fixed[1]).0, found);
            for k in 0..3 {
                worst[0][k] = worst[0][k].max((levels(found)[k] - right[k]).abs());
            }
            // Between the first two levels.
            let lambda = f64::from(k % 33) / 32.0;
            let step = 2_f64.powf(lambda) / f64::from(SIDE);
            #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
            let gradient = Gradient { dx: [step as f32, 0.0], dy: [0.0, step as f32] };
            let sampler = mipmap.sampler(Trilinear, Repeat);
            let found = sampler.packed_grad_lanes(One, [u, v], &gradient).0;
            let far = exact(&texels[(SIDE * SIDE) as usize..], SIDE as usize / 2, place);
            for k in 0..3 {
                let right = right[k] * (1.0 - lambda) + far[k] * lambda;
                worst[1][k] = worst[1][k].max((levels(found)[k] - right).abs());
            }
        }
        let [bilinear, trilinear] = worst;
        for (of, bound) in [(bilinear, [2.6, 4.8, 2.6]), (trilinear, [3.6, 6.3, 3.6])] {
            for (worst, bound) in of.into_iter().zip(bound) {
                assert!(worst <= bound && worst > 0.35 * bound, "{bilinear:?} {trilinear:?}");
            }
        }
    }

    /// Pairs are nothing but another way to the same texels, in all wraps and levels.
    #[test]
    fn means_of_pairs_are_those_of_texels() {
        fn check<W: Wrap>(wrap: W, texels: &[u16], [width, height]: [u32; 2]) {
            let mut pairs: Vec<u32> =
                texels.iter().map(|&texel| Rgb565Pairs.encode(Rgb565.decode(texel))).collect();
            Rgb565Pairs::link(&mut pairs, width, height);
            let each = Mipmap::new(Rgb565, texels, width, height).expect("levels");
            let pairs = Mipmap::new(Rgb565Pairs, &pairs, width, height).expect("levels");
            for k in 0..3000_u32 {
                let uv = [k.wrapping_mul(0x9e37_79b1), k.wrapping_mul(0x85eb_ca77)]
                    .map(|x| (x >> 13) as f32 / 131_072.0 - 2.0);
                for level in 0..each.levels() {
                    let right = each.level(level).sampler(Bilinear, wrap).packed_lanes(One, uv[0], uv[1]);
                    let found = pairs.level(level).sampler(Bilinear, wrap).packed_lanes(One, uv[0], uv[1]);
                    assert_eq!(found, right, "{wrap:?}, level {level}, {uv:?}");
                }
            }
        }
        let texels = texels();
        for sides in [[16, 16], [16, 5], [7, 8]] {
            let texels = &texels[..crate::mipmap::texel_count(sides[0], sides[1])];
            check(Repeat, texels, sides);
            check(Clamp, texels, sides);
            check(Mirror, texels, sides);
            check(Border(Rgba8::BLACK), texels, sides);
        }
    }

    #[test]
    fn equal_texels_and_centres_are_themselves() {
        let one = [0xa5c3_u16; 4];
        let texture = Texture::new(Rgb565, &one, 2, 2).expect("a texture");
        for (u, v) in (0..500_u16).map(|k| (f32::from(k) * 0.013, f32::from(k) * -0.17)) {
            assert_eq!(texture.sampler(Bilinear, Mirror).packed_lanes(One, u, v).0, 0xa5c3);
        }
        let four = [0x1234, 0xfedc, 0x0f0f, 0x8421_u16];
        let texture = Texture::new(Rgb565, &four, 2, 2).expect("a texture");
        for (k, texel) in four.iter().enumerate() {
            let [u, v] = [k % 2, k / 2].map(|k| k as f32 * 0.5 + 0.25);
            let found = texture.sampler(Bilinear, Clamp).packed_lanes(One, u, 1.0 - v).0;
            assert_eq!(found, u32::from(*texel));
        }
    }
}
