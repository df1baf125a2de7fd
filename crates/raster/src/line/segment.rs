//! The pixels of a line, and its attributes there.

use crate::interpolation::relative;
use crate::triangle::Corner;
use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_math::{Mode, Q16, Varying, high, reciprocal};
use core::ops::Range;

/// The pixels of a line by the diamond-exit rule, with the weights of its two ends.
pub(super) struct Walk {
    /// The columns, or rows of a steep line, that are left, in order, and the step from one to the next.
    next: i32,
    left: i32,
    step: i32,
    steep: bool,
    /// Subpixels of a pixel.
    one: i32,
    /// Along the longer axis: where it begins, and its length.
    start: i32,
    length: i32,
    /// Across it: the row, or column, at the next centre, less one, and what is left of the division.
    row: i32,
    rest: i64,
    more: i64,
    divisor: i64,
    /// The pixels whose diamonds the ends are in.
    first: Option<[i32; 2]>,
    last: Option<[i32; 2]>,
    limits: [Range<i32>; 2],
}

impl Walk {
    pub(super) fn new([from, to]: [[i32; 2]; 2], bits: u32, limits: &[Range<i32>; 2]) -> Self {
        let one = 1 << bits;
        let half = one >> 1;
        let steep = from[0].abs_diff(to[0]) < from[1].abs_diff(to[1]);
        let along = |[x, y]: [i32; 2]| if steep { [y, x] } else { [x, y] };
        let ([start, across], [end, across_end]) = (along(from), along(to));
        let step = if end >= start { 1 } else { -1 };
        let length = (end - start).abs();
        // The first and the last column whose centre is between the ends.
        let [low, high] = [start.min(end), start.max(end)];
        let (low, high) = ((low + half - 1) >> bits, (high - half) >> bits);
        let [low_limit, high_limit] = {
            let range = &limits[usize::from(steep)];
            [range.start, range.end - 1]
        };
        let (first_column, last_column) = if step > 0 { (low, high) } else { (high, low) };
        let (low, high) = (low.max(low_limit), high.min(high_limit));
        let next = if step > 0 { low } else { high };
        let left = (high - low + 1).max(0);
        // At a centre c the line is at across + (c − start)·slope, in the row that this over `one` is above, up to and
        // with 1: that is one less than the quotient rounded up.
        let divisor = i64::from(length) << bits;
        let slope = i64::from(across_end) - i64::from(across);
        let centre = i64::from(next) * i64::from(one) + i64::from(half) - i64::from(start);
        let numerator = i64::from(across) * i64::from(length) + centre * i64::from(step) * slope - 1;
        let (row, rest) =
            if divisor > 0 { (numerator.div_euclid(divisor), numerator.rem_euclid(divisor)) } else { (0, 0) };
        let inside = |point: [i32; 2]| diamond(point, one, steep);
        let own = inside(from).filter(|_| length > 0);
        let own_column = own.map(|place| if steep { place[1] } else { place[0] });
        // Before the first centre there may be a pixel that the line begins in.
        let between = (first_column - last_column) * step <= 0;
        let begins_before = own_column.is_some_and(|column| !between || (first_column - column) * step > 0);
        #[expect(clippy::cast_possible_truncation, reason = "rows are far within")]
        let row = row as i32;
        Self {
            next,
            left: if length > 0 { left } else { 0 },
            step,
            steep,
            one,
            start,
            length,
            row,
            rest,
            more: slope << bits,
            divisor,
            first: own.filter(|_| begins_before),
            last: inside(to),
            limits: limits.clone(),
        }
    }

    /// The weights of both ends at a pixel.
    fn weights(&self, along: i32) -> [i32; 2] {
        let centre = along * self.one + (self.one >> 1);
        let far = ((centre - self.start) * self.step).clamp(0, self.length);
        [self.length - far, far]
    }
}

/// The pixel whose diamond a point is in, if it is in one.
fn diamond([x, y]: [i32; 2], one: i32, steep: bool) -> Option<[i32; 2]> {
    let half = one >> 1;
    // Lower corners and right ones are on the border to the next pixel.
    let candidates = [[x, y], [x, y - 1], [x - 1, y]];
    candidates.into_iter().map(|place| place.map(|c| c.div_euclid(one))).find(|place| {
        let [right, down] = [x - place[0] * one - half, y - place[1] * one - half];
        let apart = right.abs() + down.abs();
        apart < half || (apart == half && (down > 0 || (steep && down == 0 && right > 0)))
    })
}

impl Iterator for Walk {
    /// The column and the row, and the weights of the first and the second end.
    type Item = ([i32; 2], [i32; 2]);

    fn next(&mut self) -> Option<Self::Item> {
        let seen = |walk: &Self, place: [i32; 2]| {
            let [columns, rows] = &walk.limits;
            columns.contains(&place[0]) && rows.contains(&place[1]) && walk.last != Some(place)
        };
        if let Some(place) = self.first.take()
            && seen(self, place)
        {
            return Some((place, self.weights(if self.steep { place[1] } else { place[0] })));
        }
        while self.left > 0 {
            let place = if self.steep { [self.row, self.next] } else { [self.next, self.row] };
            let weights = self.weights(self.next);
            self.left -= 1;
            self.next += self.step;
            self.rest += self.more;
            if self.rest >= self.divisor {
                self.rest -= self.divisor;
                self.row += 1;
            } else if self.rest < 0 {
                self.rest += self.divisor;
                self.row -= 1;
            }
            if seen(self, place) {
                return Some((place, weights));
            }
        }
        None
    }
}

/// Depth and attributes between two ends.
pub(super) trait Segment<L: Lanes, V: Varying> {
    /// The depth where the ends have these weights.
    fn depth(&self, lanes: L, weights: [i32; 2]) -> L::Depth;
    /// The attributes there.
    fn attributes(&self, lanes: L, weights: [i32; 2]) -> V::Of<L::Number>;
}

/// The ends in floats.
pub(super) struct FloatSegment<V: Varying> {
    zs: [f32; 2],
    q: [f32; 2],
    values: V::Of<[f32; 2]>,
}

impl<V: Varying> FloatSegment<V> {
    pub(super) fn new([a, b]: [&Corner<V>; 2]) -> Self {
        let pairs = V::zip(&a.components, &b.components);
        let values = V::map(&pairs, &|(a, b): (u32, u32)| [a, b].map(f32::from_bits));
        Self { zs: [a.zs(), b.zs()], q: [a.q(), b.q()], values }
    }
}

/// A mean that is between the two, whatever was rounded.
fn mean([a, b]: [f32; 2], share: f32) -> f32 {
    let value = a + (b - a) * share;
    let [least, greatest] = if a < b { [a, b] } else { [b, a] };
    if value < least {
        least
    } else if value > greatest {
        greatest
    } else {
        value
    }
}

#[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
impl<V: Varying> Segment<One, V> for FloatSegment<V> {
    fn depth(&self, _: One, [near, far]: [i32; 2]) -> f32 {
        mean(self.zs, far as f32 / (near + far).max(1) as f32)
    }

    fn attributes(&self, _: One, [near, far]: [i32; 2]) -> V::Of<f32> {
        let linear = far as f32 / (near + far).max(1) as f32;
        let [a, b] = [near as f32 * self.q[0], far as f32 * self.q[1]];
        let hyperbolic = if b > 0.0 { b / (a + b) } else { 0.0 };
        V::map_by_mode(&self.values, &|mode, values: [f32; 2]| match mode {
            Mode::Hyperbolic => mean(values, hyperbolic),
            Mode::Linear => mean(values, linear),
            Mode::Flat => values[0],
        })
    }
}

/// The ends in integers.
pub(super) struct FixedSegment<V: Varying> {
    zs: [u32; 2],
    q: [u32; 2],
    values: V::Of<[i32; 2]>,
}

impl<V: Varying> FixedSegment<V> {
    pub(super) fn new([a, b]: [&Corner<V>; 2]) -> Self {
        let pairs = V::zip(&a.components, &b.components);
        let values = V::map(&pairs, &|(a, b): (u32, u32)| [a, b].map(u32::cast_signed));
        let greatest = a.q.max(b.q) >> 23;
        Self { zs: [a.zs, b.zs], q: [a.q, b.q].map(|q| relative(q, greatest).cast_unsigned()), values }
    }
}

/// The share of the second of two numbers in units of 2^-31, at most 2^31 − 1.
fn share([a, b]: [u64; 2]) -> u32 {
    let zeros = (a + b).leading_zeros();
    let [sum, b] = [a + b, b].map(|x| ((x << zeros) >> 32) as u32);
    // 2^63 over the sum, so that the product's upper half is a share of 2^31.
    if sum == 0 { 0 } else { high(b, reciprocal::<2>(sum)) }
}

/// `from` and a share of the way to `to`.
fn between(from: i64, to: i64, share: u32) -> i64 {
    // Differences have 33 bits at most, shares 31.
    from + (((to - from) * i64::from(share)) >> 31)
}

impl<V: Varying> Segment<OneFixed, V> for FixedSegment<V> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between the two")]
    fn depth(&self, _: OneFixed, weights: [i32; 2]) -> u32 {
        let linear = share(weights.map(|weight| u64::from(weight.unsigned_abs())));
        let zs = between(self.zs[0].into(), self.zs[1].into(), linear) as u32;
        // As depth formats take words: twice as many.
        zs << 1
    }

    #[expect(clippy::cast_possible_truncation, reason = "between the two")]
    fn attributes(&self, _: OneFixed, weights: [i32; 2]) -> V::Of<Q16> {
        let weights = weights.map(|weight| u64::from(weight.unsigned_abs()));
        let linear = share(weights);
        let hyperbolic = share([weights[0] * u64::from(self.q[0]), weights[1] * u64::from(self.q[1])]);
        V::map_by_mode(&self.values, &|mode, [a, b]: [i32; 2]| {
            let share = match mode {
                Mode::Hyperbolic => hyperbolic,
                Mode::Linear => linear,
                Mode::Flat => 0,
            };
            Q16::from_bits(between(a.into(), b.into(), share) as i32)
        })
    }
}
