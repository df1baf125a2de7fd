//! Filters of texels as they are stored: for small cores, whose displays have such pixels too.

use alberti_math::lanes::Lanes;
use alberti_math::map2;

use crate::format::{Rgb565, TexelFormat};
use crate::minify::{among_levels, each_word};
use crate::{Bilinear, Gradient, MipSampler, Mipmap, Sampler, Size, Texture, Trilinear, Wrap};

/// A format whose texels can be mixed as they are stored, by weights of 5 bits.
pub trait Packed: TexelFormat {
    /// The texel in the low bits of a word, its channels apart.
    fn spread<L: Lanes>(lanes: L, texel: L::U32) -> L::U32;

    /// The nearest to the mean of two, of which the second has a share of so many 32nds.
    fn blended<L: Lanes>(lanes: L, first: L::U32, second: L::U32, share: L::U32) -> L::U32;

    /// The nearest to the mean of four by weights in 32nds, which add up to 32.
    fn mean_of_four<L: Lanes>(lanes: L, spread: [L::U32; 4], weights: [L::U32; 4]) -> L::U32;

    /// The texel of a word of channels apart.
    fn gathered<L: Lanes>(lanes: L, spread: L::U32) -> L::U32;

    /// The word of a texel.
    fn word(texel: Self::Texel) -> u32;
}

/// Green, red and blue with room above each for a product with 32.
const SPREAD: u32 = 0x07e0_f81f;
/// A half of 32 in each.
const HALVES: u32 = 16 << 21 | 16 << 11 | 16;

impl Packed for Rgb565 {
    #[inline(always)]
    fn spread<L: Lanes>(lanes: L, texel: L::U32) -> L::U32 {
        (texel | lanes.shl(texel, 16)) & lanes.word(SPREAD)
    }

    #[inline(always)]
    fn blended<L: Lanes>(lanes: L, first: L::U32, second: L::U32, share: L::U32) -> L::U32 {
        // The fields of the sum are none below 0; differences that are borrow from the next, and pay it back.
        let sum = lanes.shl(first, 5) + (second - first) * share + lanes.word(HALVES);
        lanes.shr(sum, 5) & lanes.word(SPREAD)
    }

    #[inline(always)]
    fn mean_of_four<L: Lanes>(lanes: L, [a, b, c, d]: [L::U32; 4], weights: [L::U32; 4]) -> L::U32 {
        let sum = lanes.word(HALVES) + a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3];
        lanes.shr(sum, 5) & lanes.word(SPREAD)
    }

    #[inline(always)]
    fn gathered<L: Lanes>(lanes: L, spread: L::U32) -> L::U32 {
        (spread | lanes.shr(spread, 16)) & lanes.word(0xffff)
    }

    #[inline(always)]
    fn word(texel: u16) -> u32 {
        texel.into()
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
    let [low, high] = map2(
        [low, high],
        #[inline(always)]
        |row| {
            let [pair] = texture.word_pairs(lanes, last - row, [left, right], |texel| {
                texel.map_or(0, |texel| F::word(*texel))
            });
            map2(pair, |texel| F::spread(lanes, texel))
        },
    );
    // Whole 32nds, none below 0, that add up to 32.
    let both = lanes.shr(along * up + lanes.word(16), 5);
    let [only_along, only_up] = [along - both, up - both];
    let weights = [lanes.word(32) - along - only_up, only_along, only_up, both];
    F::mean_of_four(lanes, [low[0], low[1], high[0], high[1]], weights)
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
    /// Four texels and five products of 32 bits.
    #[inline(always)]
    pub fn packed_lanes<L: Lanes>(&self, lanes: L, u: L::Number, v: L::Number) -> L::U32 {
        F::gathered(lanes, bilinear(lanes, &self.texture(), self.wraps(), [u, v]))
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
    /// Eight texels and twelve products of 32 bits; half of that where a whole level is asked for.
    #[inline(always)]
    pub fn packed_grad_lanes<L: Lanes>(
        &self,
        lanes: L,
        uv: [L::Number; 2],
        gradient: &Gradient<[L::Number; 2]>,
    ) -> L::U32 {
        let mipmap = self.mipmap();
        let lambda = gradient.lod_lanes(lanes, mipmap.size());
        let position = lanes.round_scaled(among_levels(lanes, &mipmap, lambda), 5);
        let along = position & lanes.word(31);
        let [spread] = each_word(
            lanes,
            lanes.shr(position, 5),
            #[inline(always)]
            |level| [between::<L, F, Z, U, V>(lanes, &mipmap, self.wraps(), uv, (level as usize, along))],
        );
        F::gathered(lanes, spread)
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
    F::blended(lanes, near, bilinear(lanes, &mipmap.level(level + 1), wrap, uv), along)
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
    use crate::{Clamp, Mirror, Repeat};
    use alberti_math::Q16;
    use alberti_math::lanes::{One, OneFixed};
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
