//! The pixels of a line, and its attributes there.

use crate::interpolation::relative;
use crate::triangle::Corner;
use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_math::{Mode, Q16, Varying, high, reciprocal};
use core::ops::Range;

/// The pixels of a line by the diamond-exit rule, each with how far along the line it is.
pub(super) struct Walk {
    /// The columns, or rows of a steep line, that are left, in order, and the step from one to the next.
    next: i32,
    left: i32,
    step: i32,
    steep: bool,
    bits: u32,
    /// Along the longer axis: where it begins, its length, and how far the next centre is.
    start: i32,
    length: i32,
    far: i32,
    /// Across it: the row, or column, at the next centre, and what is left of the division by the length.
    row: i32,
    rest: i32,
    more: i32,
    /// The pixels whose diamonds the ends are in.
    first: Option<[i32; 2]>,
    last: Option<[i32; 2]>,
    limits: [Range<i32>; 2],
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
        // The first and the last column whose centre is between the ends.
        let [low, high] = [start.min(end), start.max(end)];
        let (low, high) = ((low + half - 1) >> bits, (high - half) >> bits);
        let (first_column, last_column) = if step > 0 { (low, high) } else { (high, low) };
        let [columns, rows] = if steep { [&limits[1], &limits[0]] } else { [&limits[0], &limits[1]] };
        let within = columns_within((start, length * step), (across, slope), bits, rows);
        let low = low.max(columns.start).max(within.start);
        let high = high.min(columns.end - 1).min(within.end - 1);
        let next = if step > 0 { low } else { high };
        let left = if length > 0 { (high - low + 1).max(0) } else { 0 };
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
        let inside = |point: [i32; 2]| diamond(point, bits, steep);
        let own = inside(from).filter(|_| length > 0);
        let own_column = own.map(|place| if steep { place[1] } else { place[0] });
        // Before the first centre there may be a pixel that the line begins in.
        let between = (first_column - last_column) * step <= 0;
        let begins_before = own_column.is_some_and(|column| !between || (first_column - column) * step > 0);
        Self {
            next,
            left,
            step,
            steep,
            bits,
            start,
            length,
            far,
            row: base + row,
            rest,
            more: slope,
            first: own.filter(|_| begins_before),
            last: inside(to),
            limits: limits.clone(),
        }
    }

    /// How far along the line a pixel before the first centre is.
    fn before(&self, [column, row]: [i32; 2]) -> i32 {
        let along = if self.steep { row } else { column };
        let centre = (along << self.bits) + (1 << self.bits >> 1);
        ((centre - self.start) * self.step).clamp(0, self.length)
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
    let (quotient, rest) = if let Ok(number) = i32::try_from(number) {
        (number / by, number % by)
    } else {
        #[expect(clippy::cast_possible_truncation, reason = "rows and columns are far within")]
        [number / i64::from(by), number % i64::from(by)].map(|x| x as i32).into()
    };
    if rest < 0 { (quotient - 1, rest + by) } else { (quotient, rest) }
}

/// The pixel whose diamond a point is in, if it is in one.
fn diamond([x, y]: [i32; 2], bits: u32, steep: bool) -> Option<[i32; 2]> {
    let half = 1 << bits >> 1;
    // Lower corners and right ones are on the border to the next pixel.
    let candidates = [[x, y], [x, y - 1], [x - 1, y]];
    candidates.into_iter().map(|place| place.map(|c| c >> bits)).find(|place| {
        let [right, down] = [x - (place[0] << bits) - half, y - (place[1] << bits) - half];
        let apart = right.abs() + down.abs();
        apart < half || (apart == half && (down > 0 || (steep && down == 0 && right > 0)))
    })
}

impl Iterator for Walk {
    /// The column and the row, and how far along the line that is, in subpixels.
    type Item = ([i32; 2], i32);

    fn next(&mut self) -> Option<Self::Item> {
        let seen = |walk: &Self, place: [i32; 2]| {
            let [columns, rows] = &walk.limits;
            columns.contains(&place[0]) && rows.contains(&place[1]) && walk.last != Some(place)
        };
        if let Some(place) = self.first.take()
            && seen(self, place)
        {
            return Some((place, self.before(place)));
        }
        while self.left > 0 {
            let place = if self.steep { [self.row, self.next] } else { [self.next, self.row] };
            let far = self.far;
            self.left -= 1;
            self.next += self.step;
            self.far += 1 << self.bits;
            self.rest += self.more;
            if self.rest >= self.length {
                self.rest -= self.length;
                self.row += 1;
            } else if self.rest < 0 {
                self.rest += self.length;
                self.row -= 1;
            }
            if seen(self, place) {
                return Some((place, far));
            }
        }
        None
    }
}

/// Depth and attributes along a line, at places that are counted in its parts.
pub(super) trait Segment<L: Lanes, V: Varying> {
    /// The depth so far along.
    fn depth(&mut self, lanes: L, far: i32) -> L::Depth;
    /// The attributes there.
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
        mean(self.zs, far as f32 * self.part)
    }

    fn attributes(&self, _: One, far: i32) -> V::Of<f32> {
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
    /// The way to the place before, and the depth there.
    far: i32,
    zs: i64,
    /// For each part of the way, and for a pixel, which a shorter line never goes.
    more: i64,
    pixel: (i32, i64),
}

impl Sloped {
    /// From one to another in units of 2^-31, on a way of which `part` is 2^63 over its length without its zeros.
    fn new([from, to]: [u32; 2], (zeros, part): (u32, u32), pixel: i32) -> Self {
        // Towards 0, and `part` is not too large either, so that no end is passed.
        let more =
            ((u64::from(from.abs_diff(to)) * u64::from(part >> 1)) >> (31 - zeros.min(31))).cast_signed();
        let more = if to < from { -more } else { more };
        Self { far: 0, zs: i64::from(from) << 31, more, pixel: (pixel, more.wrapping_mul(i64::from(pixel))) }
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between the two")]
    fn at(&mut self, far: i32) -> u32 {
        let (pixel, more) = self.pixel;
        let way = far - self.far;
        self.zs += if way == pixel { more } else { i64::from(way) * self.more };
        self.far = far;
        (self.zs >> 31) as u32
    }
}

impl<V: Varying> FixedSegment<V> {
    /// Between two corners so many parts apart, of which a pixel has so many.
    pub(super) fn new([a, b]: [&Corner<V>; 2], length: i32, pixel: i32) -> Self {
        let pairs = V::zip(&a.components, &b.components);
        let values = V::map(&pairs, &|(a, b): (u32, u32)| [a, b].map(u32::cast_signed));
        let greatest = a.q.max(b.q) >> 23;
        let q = [a.q, b.q].map(|q| relative(q, greatest).cast_unsigned());
        let length = length.max(1).cast_unsigned();
        let zeros = length.leading_zeros();
        let part = reciprocal::<2>(length << zeros);
        Self { depth: Sloped::new([a.zs, b.zs], (zeros, part), pixel), q, values, length, zeros, part }
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
        self.depth.at(far) << 1
    }

    #[expect(clippy::cast_possible_truncation, reason = "between the two")]
    fn attributes(&self, _: OneFixed, far: i32) -> V::Of<Q16> {
        let far = far.cast_unsigned().min(self.length);
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
