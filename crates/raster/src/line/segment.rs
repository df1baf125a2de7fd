//! The pixels of a line, and its attributes there.

use crate::interpolation::relative;
use crate::triangle::Corner;
use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_math::{Mode, Q16, Varying, high, reciprocal};
use core::ops::Range;

/// The pixels of a line by the diamond-exit rule, each with how far along the line it is.
///
/// They are those at whose centres, along the longer axis, the line is, but for the one that it ends in. The one that
/// it begins in is of them wherever its centre is, as the line through both ends is in its row there.
pub(super) struct Walk {
    steep: bool,
    /// The next column, or row of a steep line, the step to the one after, and how many are left.
    next: i32,
    step: i32,
    left: i32,
    /// How far the next centre is along the longer axis, the way from one to the next, and that from end to end.
    far: i32,
    one: i32,
    length: i32,
    /// Across it: the row, or column, at the next centre, and what is left of the division by the length.
    row: i32,
    rest: i32,
    more: i32,
    /// The first row, or column, that is drawn, and how many are.
    top: i32,
    height: u32,
}

impl Walk {
    pub(super) fn new([from, to]: [[i32; 2]; 2], bits: u32, limits: &[Range<i32>; 2]) -> Self {
        let one = 1 << bits;
        let half = one >> 1;
        let steep = is_steep([from, to]);
        let along = |[x, y]: [i32; 2]| if steep { [y, x] } else { [x, y] };
        let ([start, across], [end, across_end]) = (along(from), along(to));
        let step = if end >= start { 1 } else { -1 };
        let length = (end - start).abs();
        let slope = across_end - across;
        // The first and the last column whose centre is between the ends, or that of the first pixel.
        let [low, high] = [start.min(end), start.max(end)];
        let (mut low, mut high) = ((low + half - 1) >> bits, (high - half) >> bits);
        let [begins, ends] = [[start, across], [end, across_end]].map(|end| column_of(end, bits, steep));
        let is_short = low > high;
        if let Some(column) = begins {
            [low, high] = if is_short { [column; 2] } else { [low.min(column), high.max(column)] };
        }
        if let Some(column) = ends {
            if step > 0 && column == high {
                high -= 1;
            } else if step < 0 && column == low {
                low += 1;
            }
        }
        let [columns, rows] = if steep { [&limits[1], &limits[0]] } else { [&limits[0], &limits[1]] };
        let within = columns_within((start, length * step), (across, slope), bits, rows);
        let low = low.max(columns.start).max(within.start);
        let high = high.min(columns.end - 1).min(within.end - 1);
        let next = if step > 0 { low } else { high };
        let left = if length > 0 { high - low + 1 } else { 0 };
        // At a centre c the line is at across + (c − start)·slope, in the row that this over `one` is above, up to and
        // with 1: that is one less than the quotient rounded up. Bits below a pixel are left out before the division,
        // as a step to the next centre does not change them.
        let far = ((next << bits) + half - start) * step;
        let (base, within_pixel) = (across >> bits, across & (one - 1));
        let (row, rest) = if left > 0 {
            let products = [[within_pixel, length], [far, slope]].map(|[a, b]| i64::from(a) * i64::from(b));
            divided((products[0] + products[1] - 1) >> bits, length)
        } else {
            (0, 0)
        };
        let mut walk = Self {
            steep,
            next,
            step,
            left,
            far,
            one,
            length,
            row: base + row,
            rest,
            more: slope,
            top: rows.start,
            height: (rows.end - rows.start).max(0).cast_unsigned(),
        };
        while walk.left > 0 && !walk.is_seen() {
            walk.step();
        }
        walk
    }

    /// How far along the line the first pixel is.
    pub(super) fn far(&self) -> i32 {
        self.far
    }

    #[inline(always)]
    fn is_seen(&self) -> bool {
        self.row.wrapping_sub(self.top).cast_unsigned() < self.height
    }

    #[inline(always)]
    fn step(&mut self) {
        self.left -= 1;
        self.next += self.step;
        self.far += self.one;
        self.rest += self.more;
        if self.rest >= self.length {
            self.rest -= self.length;
            self.row += 1;
        } else if self.rest < 0 {
            self.rest += self.length;
            self.row -= 1;
        }
    }
}

fn is_steep([from, to]: [[i32; 2]; 2]) -> bool {
    from[0].abs_diff(to[0]) < from[1].abs_diff(to[1])
}

/// The length of a line along its longer axis, in subpixels: what [`Walk`] has gone at its end.
pub(super) fn length([from, to]: [[i32; 2]; 2]) -> i32 {
    [0, 1].map(|axis: usize| (to[axis] - from[axis]).abs()).into_iter().fold(0, i32::max)
}

/// Whether a line has no pixel within the limits, by the box around it.
#[inline(always)]
pub(super) fn misses([from, to]: [[i32; 2]; 2], bits: u32, limits: &[Range<i32>; 2]) -> bool {
    // A place on the lower or the right border may be of the pixel before it.
    let beyond = |axis: usize| {
        let (a, b) = (from[axis], to[axis]);
        a.max(b) < limits[axis].start << bits || a.min(b) > limits[axis].end << bits
    };
    beyond(1) || beyond(0)
}

/// Columns, among which are all at whose centres a line is in these rows: it begins at `start`, and so far on it is at
/// `across` and then `slope` more. Up to two at each end are too many.
fn columns_within(
    (start, way): (i32, i32),
    (across, slope): (i32, i32),
    bits: u32,
    rows: &Range<i32>,
) -> Range<i32> {
    let [top, bottom] = [rows.start << bits, rows.end << bits];
    let steps = slope.abs();
    // From the start to the side at which it comes in, and to that at which it goes out.
    let [to_in, to_out] =
        if slope < 0 { [across - bottom, across - top] } else { [top - across, bottom - across] };
    if to_in > steps || to_out < 0 {
        return 0..0;
    }
    // Whole pixels along, until it is so far across.
    let until = |across: i32| divided((i64::from(across) * i64::from(way.abs())) >> bits, steps).0;
    let first = if to_in > 0 { until(to_in) - 1 } else { i32::MIN };
    let last = if to_out < steps { until(to_out) + 2 } else { i32::MAX };
    let column = start >> bits;
    if way >= 0 {
        column.saturating_add(first)..column.saturating_add(last)
    } else {
        column.saturating_sub(last - 1)..column.saturating_sub(first.max(-i32::MAX)).saturating_add(1)
    }
}

/// The quotient of a number by a positive one, rounded down, and what is left. Few are too great for 32 bits.
fn divided(number: i64, by: i32) -> (i32, i32) {
    let by = by.max(1);
    #[expect(clippy::cast_possible_truncation, reason = "rows and columns are far within")]
    let (quotient, rest) = if let Ok(number) = i32::try_from(number) {
        let quotient = number / by;
        (quotient, number - quotient * by)
    } else {
        let quotient = number / i64::from(by);
        (quotient as i32, (number - quotient * i64::from(by)) as i32)
    };
    if rest < 0 { (quotient - 1, rest + by) } else { (quotient, rest) }
}

/// The column, or the row of a steep line, of the pixel whose diamond has a point, if one has. The point is given by
/// its place along the line and that across it.
fn column_of([along, across]: [i32; 2], bits: u32, steep: bool) -> Option<i32> {
    let half = 1 << bits >> 1;
    let column = along >> bits;
    let [on, beside] = [along, across].map(|c| (c & (2 * half - 1)) - half);
    match on.abs() + beside.abs() {
        apart if apart < half => Some(column),
        apart if apart > half => None,
        // The border, of which lower edges and corners belong to it, of a steep line the right corner as well. Here
        // they are the upper corner of the pixel below, and the left one of the pixel beside.
        _ if steep && on < 0 => (beside == 0).then_some(column - 1),
        _ => (steep || beside > 0 || on == 0).then_some(column),
    }
}

impl Iterator for Walk {
    /// The column and the row, and how far along the line that is, in subpixels: below 0 where it begins behind the
    /// first centre.
    type Item = ([i32; 2], i32);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.left <= 0 || !self.is_seen() {
            return None;
        }
        let place = if self.steep { [self.row, self.next] } else { [self.next, self.row] };
        let far = self.far;
        self.step();
        Some((place, far))
    }
}

/// Depth and attributes along a line, at places that are counted in its parts. What is before its beginning has those
/// of the beginning.
pub(super) trait Segment<L: Lanes, V: Varying> {
    /// The depth so far along: a pixel further each time.
    fn depth(&mut self, lanes: L, far: i32) -> L::Depth;
    /// The attributes so far along.
    fn attributes(&self, lanes: L, far: i32) -> V::Of<L::Number>;
}

/// The ends in floats.
pub(super) struct FloatSegment<V: Varying> {
    zs: [f32; 2],
    q: [f32; 2],
    values: V::Of<[f32; 2]>,
    length: i32,
    /// 1 over the length.
    part: f32,
}

impl<V: Varying> FloatSegment<V> {
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    pub(super) fn new([a, b]: [&Corner<V>; 2], length: i32) -> Self {
        let pairs = V::zip(&a.components, &b.components);
        let values = V::map(&pairs, &|(a, b): (u32, u32)| [a, b].map(f32::from_bits));
        Self { zs: [a.zs(), b.zs()], q: [a.q(), b.q()], values, length, part: 1.0 / length.max(1) as f32 }
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
    fn depth(&mut self, _: One, far: i32) -> f32 {
        mean(self.zs, far.max(0) as f32 * self.part)
    }

    fn attributes(&self, _: One, far: i32) -> V::Of<f32> {
        let far = far.max(0);
        let linear = far as f32 * self.part;
        let [a, b] = [(self.length - far) as f32 * self.q[0], far as f32 * self.q[1]];
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
    depth: Sloped,
    q: [u32; 2],
    values: V::Of<[i32; 2]>,
    length: u32,
    /// The bits by which the length is below 2^32, and 2^63 over it when it is moved by them.
    zeros: u32,
    part: u32,
}

/// A depth that grows with the way, in units of 2^-62: by integers, so that sums have no errors, wherever they begin.
struct Sloped {
    /// At the beginning of the line.
    from: i64,
    /// At the next pixel, and what it grows by from one to the next, which a shorter line never does.
    zs: i64,
    pixel: i64,
}

impl Sloped {
    /// From one to another in units of 2^-31, on a way of which `part` is 2^63 over its length without its zeros. The
    /// first pixel is so far along it, the next one `pixel` further.
    fn new([from, to]: [u32; 2], (zeros, part): (u32, u32), [first, pixel]: [i32; 2]) -> Self {
        // Towards 0, and `part` is not too large either, so that no end is passed.
        let more =
            ((u64::from(from.abs_diff(to)) * u64::from(part >> 1)) >> (31 - zeros.min(31))).cast_signed();
        let more = if to < from { -more } else { more };
        let from = i64::from(from) << 31;
        let [first, pixel] = [first, pixel].map(|way| more.wrapping_mul(i64::from(way)));
        Self { from, zs: from.wrapping_add(first), pixel }
    }

    /// At the pixel that is so far along, and then at the next.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between the two")]
    fn next(&mut self, far: i32) -> u32 {
        let zs = if far < 0 { self.from } else { self.zs };
        self.zs = self.zs.wrapping_add(self.pixel);
        (zs >> 31) as u32
    }
}

impl<V: Varying> FixedSegment<V> {
    /// Between two corners so many parts apart. The first pixel is so far from one, the next so far from the first.
    pub(super) fn new([a, b]: [&Corner<V>; 2], length: i32, pixels: [i32; 2]) -> Self {
        let pairs = V::zip(&a.components, &b.components);
        let values = V::map(&pairs, &|(a, b): (u32, u32)| [a, b].map(u32::cast_signed));
        let greatest = a.q.max(b.q) >> 23;
        let q = [a.q, b.q].map(|q| relative(q, greatest).cast_unsigned());
        let length = length.max(1).cast_unsigned();
        let zeros = length.leading_zeros();
        let part = reciprocal::<2>(length << zeros);
        Self { depth: Sloped::new([a.zs, b.zs], (zeros, part), pixels), q, values, length, zeros, part }
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
    #[inline(always)]
    fn depth(&mut self, _: OneFixed, far: i32) -> u32 {
        // As depth formats take words: twice as many.
        self.depth.next(far) << 1
    }

    #[expect(clippy::cast_possible_truncation, reason = "between the two")]
    fn attributes(&self, _: OneFixed, far: i32) -> V::Of<Q16> {
        let far = far.max(0).cast_unsigned().min(self.length);
        let linear = high(far << self.zeros, self.part);
        let [a, b] = [self.length - far, far].map(u64::from);
        let hyperbolic = share([a * u64::from(self.q[0]), b * u64::from(self.q[1])]);
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

/// One corner, whose depth and attributes all pixels have.
pub(super) struct Still<V: Varying> {
    zs: u32,
    values: V::Of<u32>,
}

impl<V: Varying> Still<V> {
    pub(super) fn new(corner: &Corner<V>) -> Self {
        Self { zs: corner.zs, values: V::map(&corner.components, &|word: u32| word) }
    }
}

impl<V: Varying> Segment<One, V> for Still<V> {
    fn depth(&mut self, _: One, _: i32) -> f32 {
        f32::from_bits(self.zs)
    }

    fn attributes(&self, _: One, _: i32) -> V::Of<f32> {
        V::map(&self.values, &f32::from_bits)
    }
}

impl<V: Varying> Segment<OneFixed, V> for Still<V> {
    fn depth(&mut self, _: OneFixed, _: i32) -> u32 {
        self.zs << 1
    }

    fn attributes(&self, _: OneFixed, _: i32) -> V::Of<Q16> {
        V::map(&self.values, &|word: u32| Q16::from_bits(word.cast_signed()))
    }
}
