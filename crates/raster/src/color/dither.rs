//! Rounding to a display's few levels by a pattern, so that the eye finds the shades between them again.

use super::formats::store_levels;
use super::{ColorFormat, FragmentColor, Levels, ReadColor};
use alberti_math::Rgba8;
use alberti_math::lanes::Lanes;
use core::fmt::Debug;

mod noise;

/// A colour format in which a channel between two levels becomes either, by the pixel's place: for
/// [`Target::new`](crate::Target::new), or [`Target::with_color`](crate::Target::with_color).
///
/// A level is ⌊c·greatest/255 + t⌋, with t from 0 to 1 by the pattern. What is a level already, such as black and
/// white, stays; the mean over a pattern is that of the channel.
///
/// ```
/// use alberti_math::{Rgb565Be, Rgba8};
/// use alberti_raster::{NoDepth, Target, color::{Bayer, Dithered}};
///
/// let (mut color, mut depth) = ([0; 4], [(); 4]);
/// let format = Dithered { format: Rgb565Be, by: Bayer };
/// let mut target = Target::new(format, NoDepth, 2, 2, &mut color, &mut depth)?;
/// # Ok::<(), alberti_raster::TargetError>(())
/// ```
///
/// # Precision
/// The mean level over a pattern is within half of one part in 64 (or 1024) of c·greatest/255, and a 255th of it.
/// [`clear`](crate::Target::clear) is to the nearest level everywhere.
///
/// # Cost
/// A load from a table of 64 (1024) bytes, and for each channel a product, a sum and a division by 255, which is a
/// product and a shift.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Dithered<C, P> {
    /// The format of the pixels.
    pub format: C,
    /// The pattern.
    pub by: P,
}

impl<C: Levels, P: Pattern> ColorFormat for Dithered<C, P> {
    type Pixel = C::Pixel;

    #[inline(always)]
    fn pixel(self, color: Rgba8) -> C::Pixel {
        self.format.pixel(color)
    }

    #[inline(always)]
    fn native(self, word: u32) -> C::Pixel {
        self.format.native(word)
    }

    #[inline(always)]
    fn store<L: Lanes, Shade: FragmentColor>(
        self,
        lanes: L,
        colors: L::U32,
        mask: L::Mask,
        place: [i32; 2],
        pixels: &mut L::Each<C::Pixel>,
    ) {
        let thresholds = self.by.thresholds(lanes, place);
        store_levels::<C, L, Shade>(self.format, lanes, (colors, thresholds), mask, pixels);
    }
}

impl<C: Levels, P: Pattern> ReadColor for Dithered<C, P> {
    #[inline(always)]
    fn color(self, pixel: C::Pixel) -> Rgba8 {
        self.format.color(pixel)
    }
}

/// A pattern of thresholds, which repeats.
pub trait Pattern: Copy + Debug + Send + Sync + 'static {
    /// The threshold of a pixel in 255ths of a level, from 0 to 254; all are as frequent as the others in a pattern.
    fn threshold(self, place: [i32; 2]) -> u32;

    /// Those of as many pixels from one on as there are lanes.
    #[inline(always)]
    fn thresholds<L: Lanes>(self, lanes: L, [column, row]: [i32; 2]) -> L::U32 {
        lanes.load_words(&lanes.each(|k| {
            let column = column.wrapping_add(i32::try_from(k).unwrap_or(0));
            self.threshold([column, row])
        }))
    }
}

/// Rows of a pattern, each with so many of its first thresholds behind it that lanes find theirs side by side.
const fn continued<const SIDE: usize, const WIDTH: usize>(rows: &[u8]) -> [[u8; WIDTH]; SIDE] {
    let mut table = [[0; WIDTH]; SIDE];
    let mut place = 0;
    while place < SIDE * WIDTH {
        let (column, row) = (place % WIDTH, place / WIDTH);
        table[row][column] = rows[row * SIDE + column % SIDE];
        place += 1;
    }
    table
}

/// The thresholds of lanes from a place on in [`continued`] rows, which have sixteen more than the pattern.
#[inline(always)]
fn side_by_side<L: Lanes, const SIDE: usize, const WIDTH: usize>(
    lanes: L,
    table: &[[u8; WIDTH]; SIDE],
    place: [i32; 2],
) -> L::U32 {
    const { assert!(L::COUNT <= 16 && SIDE + 16 == WIDTH, "rows are continued for sixteen lanes") };
    let [column, row] = place.map(|k| k.cast_unsigned() as usize % SIDE);
    let row = table[row].get(column..column + L::COUNT).unwrap_or_default();
    lanes.load_words(&lanes.each(|k| row.get(k).map_or(0, |&threshold| threshold.into())))
}

/// The ordered pattern of 8 x 8 pixels (Bayer 1973): the finest texture there is, which shows as a weave.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bayer;

impl Pattern for Bayer {
    #[inline(always)]
    fn threshold(self, place: [i32; 2]) -> u32 {
        const TABLE: [u8; 64] = bayer();
        let [column, row] = place.map(|k| k.cast_unsigned() as usize % 8);
        TABLE[row * 8 + column].into()
    }

    #[inline(always)]
    fn thresholds<L: Lanes>(self, lanes: L, place: [i32; 2]) -> L::U32 {
        static TABLE: [[u8; 8 + 16]; 8] = continued(&bayer());
        if const { L::COUNT == 1 } {
            return lanes.word(self.threshold(place));
        }
        side_by_side(lanes, &TABLE, place)
    }
}

/// Bits of x xor y and of y in turns, the lowest first in value: no two neighbours have thresholds near each other.
const fn bayer() -> [u8; 64] {
    let mut table = [0; 64];
    let mut place = 0;
    while place < 64 {
        let (x, y) = (place % 8, place / 8);
        let (mut rank, mut bit) = (0, 0);
        while bit < 3 {
            rank = rank << 2 | ((x ^ y) >> bit & 1) << 1 | y >> bit & 1;
            bit += 1;
        }
        table[place] = middle(rank, 64);
        place += 1;
    }
    table
}

/// The middle of the part of 255ths that a rank of so many has.
#[expect(clippy::cast_possible_truncation, reason = "below 255")]
const fn middle(rank: usize, count: usize) -> u8 {
    ((2 * rank + 1) * 255 / (2 * count)) as u8
}

/// Blue noise of 32 x 32 pixels (Ulichney's void and cluster, 1993): no texture at all, and no clumps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BlueNoise;

impl Pattern for BlueNoise {
    #[inline(always)]
    fn threshold(self, place: [i32; 2]) -> u32 {
        let [column, row] = place.map(|k| k.cast_unsigned() as usize % noise::SIDE);
        noise::THRESHOLDS[row * noise::SIDE + column].into()
    }

    #[inline(always)]
    fn thresholds<L: Lanes>(self, lanes: L, place: [i32; 2]) -> L::U32 {
        static TABLE: [[u8; noise::SIDE + 16]; noise::SIDE] = continued(&noise::THRESHOLDS);
        if const { L::COUNT == 1 } {
            return lanes.word(self.threshold(place));
        }
        side_by_side(lanes, &TABLE, place)
    }
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "tables are small")]
mod tests {
    use super::*;
    use crate::color::{Grey1, Rgb332};
    use alberti_math::lanes::One;
    use std::collections::HashMap;
    use std::vec::Vec;

    /// Each byte's mean level over a pattern, by the definition in reals.
    fn means(pattern: impl Pattern, side: i32) {
        let places = || (0..side).flat_map(|y| (0..side).map(move |x| [x - 3, y + 5]));
        let count = f64::from(side * side);
        for byte in 0..=255_u8 {
            let color = Rgba8::new(byte, byte, byte, 255);
            let (mut greens, mut whites) = (0, 0);
            for place in places() {
                let mut pixel = [0xff_u8];
                let format = Dithered { format: Rgb332, by: pattern };
                format.store::<One, Rgba8>(One, One.word(color.to_bits()), true, place, &mut pixel);
                greens += u32::from(pixel[0] >> 2 & 7);
                let format = Dithered { format: Grey1, by: pattern };
                format.store::<One, Rgba8>(One, One.word(color.to_bits()), true, place, &mut pixel);
                whites += u32::from(pixel[0]);
            }
            for (sum, greatest) in [(greens, 7.0), (whites, 1.0)] {
                let expected = f64::from(byte) * greatest / 255.0;
                let off = (f64::from(sum) / count - expected).abs();
                assert!(off <= 0.5 / count + 1.0 / 255.0, "{byte}: {off}");
            }
        }
    }

    #[test]
    fn the_mean_over_a_pattern_is_the_colour() {
        means(Bayer, 8);
        means(BlueNoise, 32);
    }

    #[test]
    fn thresholds_of_lanes_are_those_of_their_pixels() {
        let (weave, noise) = (continued::<8, 24>(&bayer()), continued::<32, 48>(&noise::THRESHOLDS));
        for place in (-40..40).map(|k| [k, 3 * k + 7]) {
            for k in 0..16_u8 {
                let at = [place[0] + i32::from(k), place[1]];
                let index = |side: i32| place.map(|c| c.rem_euclid(side) as usize);
                let ([x, y], [column, row]) = (index(8), index(32));
                assert_eq!(u32::from(weave[y][x + usize::from(k)]), Bayer.threshold(at));
                assert_eq!(u32::from(noise[row][column + usize::from(k)]), BlueNoise.threshold(at));
            }
        }
    }

    /// Of twice the side: four times the smaller one's ranks, and 0, 2, 3, 1 in its quarters by rows.
    #[test]
    fn the_weave_is_that_of_bayer() {
        let rank = |[x, y]: [usize; 2]| {
            (0..3).fold(0, |rank, bit| 4 * rank + [[0, 2], [3, 1]][y >> bit & 1][x >> bit & 1])
        };
        assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|x| rank([x, 0])), [0, 32, 8, 40, 2, 34, 10, 42]);
        for place in (0..64).map(|k| [k % 8, k / 8]) {
            let middle = (2 * rank(place) + 1) * 255 / 128;
            assert_eq!(Bayer.threshold(place.map(|k| k as i32)), middle, "{place:?}");
        }
    }

    #[test]
    fn thresholds_are_as_frequent_as_each_other() {
        for side in [8, 32] {
            let mut found: HashMap<u32, u32> = HashMap::new();
            for place in (0..side).flat_map(|y| (0..side).map(move |x| [x, y])) {
                let threshold = if side == 8 { Bayer.threshold(place) } else { BlueNoise.threshold(place) };
                assert!(threshold < 255);
                *found.entry(threshold).or_default() += 1;
            }
            let (least, most) = (found.values().min(), found.values().max());
            assert!(most.zip(least).is_some_and(|(most, least)| most - least <= 1), "{found:?}");
        }
    }

    /// A set of pixels on a torus, and how crowded each place is.
    struct Crowd {
        there: Vec<bool>,
        density: Vec<f64>,
    }

    impl Crowd {
        fn toggle(&mut self, place: usize) {
            let sign = if self.there[place] { -1.0 } else { 1.0 };
            self.there[place] = !self.there[place];
            let apart = |a: usize, b: usize| a.abs_diff(b).min(noise::SIDE - a.abs_diff(b));
            for (k, density) in self.density.iter_mut().enumerate() {
                let (x, y) = (k % noise::SIDE, k / noise::SIDE);
                let square = apart(x, place % noise::SIDE).pow(2) + apart(y, place / noise::SIDE).pow(2);
                // e^(-d²/2σ²) with σ = 1.5.
                *density += sign * 0.800_737_402_9_f64.powi(square as i32);
            }
        }

        /// The first of the most crowded places that are taken, or of the emptiest that are not.
        fn extreme(&self, taken: bool) -> usize {
            let mut best = None;
            for (k, &density) in self.density.iter().enumerate().filter(|(k, _)| self.there[*k] == taken) {
                let better = |least: f64| if taken { density > least + 1e-9 } else { density < least - 1e-9 };
                if best.is_none_or(|(_, least)| better(least)) {
                    best = Some((k, density));
                }
            }
            best.expect("a place").0
        }
    }

    /// The ranks by void and cluster.
    fn ranks() -> Vec<usize> {
        const COUNT: usize = noise::SIDE * noise::SIDE;
        let mut crowd = Crowd { there: std::vec![false; COUNT], density: std::vec![0.0; COUNT] };
        let (mut state, mut ones) = (1_u32, 0);
        while ones < COUNT / 10 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let place = (state >> 16) as usize % COUNT;
            if !crowd.there[place] {
                crowd.toggle(place);
                ones += 1;
            }
        }
        loop {
            let cluster = crowd.extreme(true);
            crowd.toggle(cluster);
            let void = crowd.extreme(false);
            crowd.toggle(void);
            if void == cluster {
                break;
            }
        }
        let first = crowd.there.clone();
        let mut ranks = std::vec![0; COUNT];
        for rank in (0..ones).rev() {
            let place = crowd.extreme(true);
            crowd.toggle(place);
            ranks[place] = rank;
        }
        (0..COUNT).filter(|k| first[*k]).for_each(|k| crowd.toggle(k));
        for rank in ones..COUNT {
            let place = crowd.extreme(false);
            crowd.toggle(place);
            ranks[place] = rank;
        }
        ranks
    }

    #[test]
    fn blue_noise_is_void_and_cluster() {
        let table: Vec<u8> = ranks().into_iter().map(|rank| middle(rank, 1024)).collect();
        assert!(table == noise::THRESHOLDS, "{table:?}");
    }

    /// Of what a pattern makes of greys, the share of the power at waves longer than eight pixels: next to none, where
    /// that of thresholds at random is a twentieth.
    #[test]
    fn blue_noise_has_no_long_waves() {
        let side = noise::SIDE as i32;
        let power = |of: &dyn Fn([i32; 2]) -> f64, [u, v]: [i32; 2]| {
            let (mut re, mut im) = (0.0, 0.0);
            for [x, y] in (0..side).flat_map(|y| (0..side).map(move |x| [x, y])) {
                let phase = f64::from(u * x + v * y) / f64::from(side) * std::f64::consts::TAU;
                re += of([x, y]) * phase.cos();
                im += of([x, y]) * phase.sin();
            }
            re * re + im * im
        };
        for grey in [40, 90, 128, 200] {
            let dots = |place| f64::from(u8::from(grey > BlueNoise.threshold(place)));
            let (mut long, mut all) = (0.0, 0.0);
            for [u, v] in
                (-16..16).flat_map(|v| (-16..16).map(move |u| [u, v])).filter(|wave| *wave != [0; 2])
            {
                let power = power(&dots, [u, v]);
                all += power;
                long += if u * u + v * v < 16 { power } else { 0.0 };
            }
            assert!(long / all < 0.01, "{grey}: {}", long / all);
        }
    }
}
