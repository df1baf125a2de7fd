//! Levels whose texels cover parts of texels of the ones before, so that each is made of level 0. They share its sums
//! along a row: from the beginning of a strip to where a texel of any of the levels begins.
//!
//! ```text
//! level 0   |   |   |   |   |   |   |   |   |   |   |
//!      1    |       :     |     :       |
//!      2    |                   :       |
//!                   ^     ^     ^       ^    cuts, which may lie in texels of level 0
//! ```

use core::mem::take;
use core::ops::Range;

use super::build::{Piece, SHARED, first_of, lowest};
use super::mean::{LOW, Packed, packed, sum};
use super::size_of_level;
use crate::format::TexelFormat;

/// Room for where the texels of a strip begin and end: at most 63, 31, 15, 7, 3 and 1 of six levels.
const CUTS: usize = 128;

/// A place where a texel begins or ends.
#[derive(Clone, Copy, Default)]
struct Cut {
    /// The texel of level 0 that it is in.
    texel: u16,
    /// The parts of that before the cut, and all of them.
    before: u16,
    parts: u16,
    /// Its number in the order of levels.
    number: usize,
}

/// That of a level which is in a strip.
#[derive(Clone, Default)]
struct Section {
    columns: Range<usize>,
    /// The rows that are not filled yet.
    rows: Range<u32>,
    /// The parts of rows of level 0 that a row covers, and those of one.
    parts: [u32; 2],
    /// The numbers of its cuts, one more than columns.
    cuts: Range<usize>,
}

impl<F: TexelFormat> Piece<'_, F> {
    /// Fills what lies in a column of the last level, and in some of its rows.
    pub(super) fn fill_strip(&mut self, x: u32, rows: Range<u32>) {
        let (mut sections, mut cuts) = (<[Section; SHARED]>::default(), [Cut::default(); CUTS]);
        let mut count = 0;
        let [all_columns, all_rows] = size_of_level(self.size, self.last);
        let levels = self.levels.iter().take(self.last + 1).skip(self.first);
        for (section, level) in sections.iter_mut().zip(levels) {
            let [[first, end], [top, bottom]] = [
                [x, x + 1].map(|x| first_of(x, [level.size[0], all_columns])),
                [rows.start, rows.end].map(|y| first_of(y, [level.size[1], all_rows])),
            ];
            let [wide, parts] = lowest([self.size[0], level.size[0]]);
            let begin = count;
            for (cut, column) in cuts.iter_mut().skip(begin).zip(first..=end) {
                let place = column * wide;
                #[expect(clippy::cast_possible_truncation, reason = "at most 2^14")]
                let [texel, before, parts] = [place / parts, place % parts, parts].map(|k| k as u16);
                *cut = Cut { texel, before, parts, number: count };
                count += 1;
            }
            *section = Section {
                columns: first as usize..end as usize,
                rows: top..bottom,
                parts: lowest([self.size[1], level.size[1]]),
                cuts: begin..count,
            };
        }
        if let Some(cuts) = cuts.get_mut(..count) {
            cuts.sort_unstable_by_key(|cut| cut.texel);
            self.fill_sections(&mut sections, cuts);
        }
    }

    /// Fills the sections, by cuts in their order along a row.
    fn fill_sections(&mut self, sections: &mut [Section; SHARED], cuts: &[Cut]) {
        let first =
            sections.iter().map(|section| section.rows.start * section.parts[0] / section.parts[1].max(1));
        let first = first.min().unwrap_or_default() as usize;
        let (mut sums, mut before) = ([Sums::default(); CUTS], [Packed::default(); CUTS]);
        for (y, row) in (0..).zip(self.largest.chunks_exact(self.size[0] as usize)).skip(first) {
            set_before(self.format, row, cuts, &mut before);
            for (section, level) in sections.iter_mut().zip(self.levels.iter_mut().skip(self.first)) {
                let [high, parts] = section.parts;
                let sums = sums.get_mut(section.cuts.clone()).unwrap_or_default();
                let before = before.get(section.cuts.clone()).unwrap_or_default();
                while section.rows.start < section.rows.end {
                    let [top, bottom] = [section.rows.start, section.rows.start + 1].map(|y| y * high);
                    let weight = bottom.min((y + 1) * parts).saturating_sub(top.max(y * parts));
                    add(sums, before, weight);
                    if (y + 1) * parts < bottom {
                        break;
                    }
                    let weights = level.weights;
                    let texels =
                        level.row(section.rows.start).and_then(|row| row.get_mut(section.columns.clone()));
                    for (sums, texel) in sums.iter_mut().zip(texels.unwrap_or_default()) {
                        let [[a, c], [b, d]] = take(sums);
                        *texel = self.format.mean(self.format.content(), [a, b, c, d], weights);
                    }
                    section.rows.start += 1;
                }
            }
            if sections.iter().all(|section| section.rows.is_empty()) {
                return;
            }
        }
    }
}

/// The sums of a row from the first cut to each, times its parts. Not inlined: its loop needs all registers.
#[inline(never)]
fn set_before<F: TexelFormat>(format: F, row: &[F::Texel], cuts: &[Cut], before: &mut [Packed; CUTS]) {
    // None behind the end of the row.
    let addends = |at: usize| row.get(at).map_or([0; 2], |&texel| packed(format, texel));
    let mut at = cuts.first().map_or(0, |cut| cut.texel.into());
    let mut sums = [0; 2];
    let mut own = addends(at);
    for cut in cuts {
        let texel = usize::from(cut.texel);
        if at < texel {
            let between = row.get(at + 1..texel).unwrap_or_default();
            sums = between.iter().fold(sum(sums, own), |sums, &texel| sum(sums, packed(format, texel)));
            (at, own) = (texel, addends(texel));
        }
        let [begin, parts] = [cut.before, cut.parts].map(u64::from);
        let of = |k: usize| sums[k].wrapping_mul(parts).wrapping_add(own[k].wrapping_mul(begin));
        if let Some(before) = before.get_mut(cut.number) {
            *before = [of(0), of(1)];
        }
    }
}

/// Sums of a texel: of the lower addends in each word, and of the upper.
type Sums = [[u64; 2]; 2];

/// Adds what is between cuts, so many times. That is below 2^30, since a texel covers at most 2^14 parts of a row.
#[inline(never)]
fn add(sums: &mut [Sums], before: &[Packed], times: u32) {
    let times = u64::from(times);
    for (sums, (from, to)) in sums.iter_mut().zip(before.iter().zip(before.iter().skip(1))) {
        let part = [to[0].wrapping_sub(from[0]), to[1].wrapping_sub(from[1])];
        let [low, high] = sums;
        for k in 0..2 {
            low[k] += (part[k] & LOW) * times;
            high[k] += (part[k] >> 32) * times;
        }
    }
}
