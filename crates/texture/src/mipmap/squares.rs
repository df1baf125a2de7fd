//! Levels, each of half the sides of the one before: a texel covers whole texels of that, so that its sums are sums of
//! theirs, before these are rounded.
//!
//! ```text
//!  +---+---+-------+    in the order 1 2 3 4 (5), and so on: what waits for its
//!  | 1 | 2 |       |    square to be full is a sum a level, not a row a level
//!  +--(5)--+       |
//!  | 3 | 4 |       |
//!  +---+---+-------+
//! ```

use alberti_math::map2;

use super::build::Piece;
use super::mean::{packed, sum, unpacked};
use super::size_of_level;
use crate::format::TexelFormat;

impl<F: TexelFormat> Piece<'_, F> {
    /// The sums of the part of level 0 that a texel covers. It is filled, and so are those of the levels from 1 on that
    /// it covers. Calls are as deep as there are levels.
    pub(super) fn sums(&mut self, level: usize, [x, y]: [u32; 2]) -> [u64; 4] {
        if level <= 1 {
            return self.sums_of_first([x, y]);
        }
        // A side of one texel is not halved.
        let [across, down] = map2(size_of_level(self.size, level - 1), |side| side.min(2));
        let mut sums = [0; 4];
        for row in y * down..(y + 1) * down {
            for column in x * across..(x + 1) * across {
                let place = [column, row];
                let part = if level == 2 { self.sums_of_first(place) } else { self.sums(level - 1, place) };
                sums = [0, 1, 2, 3].map(|k: usize| sums[k] + part[k]);
            }
        }
        self.fill(level, [x, y], sums);
        sums
    }

    /// The same of level 1.
    #[inline]
    fn sums_of_first(&mut self, [x, y]: [u32; 2]) -> [u64; 4] {
        let [across, down] = map2(self.size, |side| side.min(2));
        let begin = (y * down * self.size[0] + x * across) as usize;
        let row = |begin: usize| match self.largest.get(begin..begin + across as usize) {
            Some(&[left, right]) => sum(packed(self.format, left), packed(self.format, right)),
            Some(&[only]) => packed(self.format, only),
            _ => [0; 2],
        };
        let mut sums = row(begin);
        if down == 2 {
            sums = sum(sums, row(begin + self.size[0] as usize));
        }
        let sums = unpacked(sums);
        self.fill(1, [x, y], sums);
        sums
    }

    /// Stores the mean that is made of these sums.
    #[inline]
    fn fill(&mut self, level: usize, place: [u32; 2], sums: [u64; 4]) {
        let Some(level) = self.levels.get_mut(level) else { return };
        let weights = level.weights;
        if let Some(texel) = level.texel(place) {
            *texel = self.format.mean(self.format.content(), sums, weights);
        }
    }
}
