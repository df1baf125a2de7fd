//! Steps 1, 2, 4 and 6 in integers, for vertices in half words: on a core without floating point, a thirteenth of the
//! work.
//!
//! x and y are measured in powers of two of subpixels, the least that are not below half the viewport. So what can be
//! seen has |x|, |y| <= w, and the quotients need only be shifted.
//!
//! # Precision
//! A coordinate is within 2^-28 of the greatest that the mesh may have. Its factors are rounded as floats are, which is
//! at most 2^-22 of that. xs, ys, zs and q come short by up to 2^-27, relatively. So vertices in the view are within a
//! quarter of a subpixel, where that coordinate, half the viewport in subpixels, and q have a product up to 2^20.

use crate::screen::Sides;
use crate::vertex::outside;
use alberti_math::lanes::One;
use alberti_math::{
    Eye, Frame, Object, Subpixel, high_signed, map2, map3, middle, reciprocal_signed, scaled,
};
use alberti_projection::{Projection, Viewport};

/// A coordinate as a function of the mesh's integers.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// In 2^-16 of the origin's unit.
    factors: [i32; 3],
    origin: i32,
}

impl Row {
    #[inline(always)]
    fn at(&self, [x, y, z]: [i16; 3]) -> i32 {
        let [a, b, c] = self.factors;
        // Below 2^30 together.
        middle(a, x).wrapping_add(middle(b, y)).wrapping_add(middle(c, z)).wrapping_add(self.origin)
    }
}

/// The map to the screen depth in 2^-28, as the depth buffer rounds it: the high word of a product, and a sum.
#[derive(Clone, Copy, Debug)]
struct Depth {
    base: i32,
    /// The z that is taken off before, in parallel projection.
    zero: i32,
    /// The factor of 1/w, in perspective, or of z.
    factor: i32,
    /// The number of bits that are too many in perspective, where w has no leading zeros, or that z has too few.
    shift: u32,
}

/// A distance in the unit of coordinates, up to which floats may see a vertex on the other side of a plane: 2^-20 of
/// the greatest. Vertices as near are clipped with all of their triangles, so that these agree.
const DOUBT: i32 = 1 << 10;

/// Bits of xs and ys.
const SCREEN: i32 = 29;
/// Bits of zs.
const DEPTH: i32 = 28;

impl Depth {
    /// zs = α + β/z, for planes of which the far one is at least twice as far.
    fn hyperbolic([near, far]: [f32; 2], units: i32, bits: u32, reversed: bool) -> Option<Self> {
        let alpha = if far.is_finite() { far / (far - near) } else { 1.0 };
        if alpha > 2.0 || alpha.is_nan() {
            return None;
        }
        let [scale, half] = rounding(bits);
        let (base, beta) = if reversed { (1.0 - alpha, near * alpha) } else { (alpha, -near * alpha) };
        let beta = beta * scale;
        let exponent = (beta.to_bits() >> 23 & 0xff).cast_signed() - 127;
        let shift = u32::try_from(32 - exponent - units).ok()?;
        let base = scaled(base * scale + half, DEPTH);
        Some(Self { base, zero: 0, factor: scaled(beta, 30 - exponent), shift })
    }

    /// zs from 0 to 1 between these planes, for z from -`reach` to `reach`.
    fn linear([near, far]: [f32; 2], reach: f32, units: i32, bits: u32, reversed: bool) -> Option<Self> {
        let [low, high] = [near, far].map(|plane| plane.max(-reach).min(reach));
        let zero = scaled(low, units);
        let span = scaled(high, units).checked_sub(zero).filter(|&span| span > 0)?;
        let shift = span.leading_zeros() - 1;
        let [scale, half] = rounding(bits);
        // zs at `zero`.
        let base = (low - near) / (far - near);
        let (base, scale) =
            if reversed { ((1.0 - base) * scale + half, -scale) } else { (base * scale + half, scale) };
        let factor = scaled(scale / (far - near), DEPTH + 33 - shift.cast_signed() - units);
        Some(Self { base: scaled(base, DEPTH), zero, factor, shift })
    }

    /// zs in 2^-31.
    #[inline(always)]
    fn at(&self, part: i32) -> u32 {
        let zs = self.base.wrapping_add(part).clamp(0, (1 << DEPTH) - 1);
        (zs << (31 - DEPTH)).cast_unsigned()
    }
}

/// The factor and the summand of depths that come to be cut to so many bits.
fn rounding(bits: u32) -> [f32; 2] {
    if bits > 24 {
        return [1.0, 0.0];
    }
    let step = f32::from_bits((127 - bits) << 23);
    [1.0 - step, step / 2.0]
}

/// The numbers that lead from integers to the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IntegerScreen {
    /// To the right, down, and forward.
    rows: [Row; 3],
    /// The least and the greatest z between the planes.
    planes: [i32; 2],
    /// The same by so much farther inside that floats agree; none where sides are in doubt too.
    inner: [i32; 2],
    /// Whether the clip is at the sides.
    cube: bool,
    /// w where that is not z.
    one: i32,
    /// The sides of the view, in 2^-29.
    sides: [i32; 2],
    /// Halves of a subpixel, to be added to xs and ys, and the number of their bits that go then.
    halves: [i32; 2],
    shifts: [u32; 2],
    center: [i32; 2],
    depth: Depth,
    /// The exponent of q, less one, where w has no leading zeros.
    exponent: u32,
    /// The guard band, in 2^-8, a little inside of it.
    guard: [i32; 2],
}

/// A vertex on the screen: its bits of [`outside`], subpixels, zs in 2^-31 and q as a word of `f32`.
pub(crate) struct Place {
    pub(crate) outside: u32,
    pub(crate) place: [i32; 2],
    pub(crate) depths: [u32; 2],
}

impl IntegerScreen {
    /// The way for integers in this unit, to depths of so many bits. `None` where integers do not hold it. Such are
    /// frames that are not finite, far planes not twice as far as the near one, viewports as wide as the guard band.
    #[inline(never)]
    pub(crate) fn new<Pr: Projection>(
        (to_eye, unit): (&Frame<Object, Eye>, f32),
        projection: &Pr,
        (viewport, subpixel, sides): (&Viewport, Subpixel, Sides),
        (depth_bits, reversed): (u32, bool),
    ) -> Option<Self> {
        let sizes = viewport.pixels().map(|range| (range.end - range.start) << (subpixel.bits() - 1));
        let bits_of = |size: i32| 32 - (size - 1).leading_zeros();
        let bits = sizes.map(bits_of);
        // Halves of the viewport in powers of two, from 1/2 to 1.
        let halves = sizes.map(|size| {
            #[expect(clippy::cast_precision_loss, reason = "at most 2^22")]
            let half = size as f32;
            half / f32::from_bits((127 + bits_of(size)) << 23)
        });
        let [scale_x, scale_y, _] = projection.scale_lanes(One, [1.0; 3]);
        let (axes, origin) = (to_eye.axes().transpose(), to_eye.origin().coords.to_array());
        let axes = [axes.x_axis, axes.y_axis, axes.z_axis].map(|row| row.to_array().map(|c| c * unit));
        let perspective = projection.is_perspective();
        // Axes are constants below, or compilers check them where they compile for size.
        let reach = |axis: [f32; 3], origin: f32| {
            let [a, b, c] = axis.map(f32::abs);
            (a + b + c) * 32768.0 + origin.abs()
        };
        let reaches = [reach(axes[0], origin[0]), reach(axes[1], origin[1]), reach(axes[2], origin[2])];
        // In parallel projection z is measured by its own reach, a power of two, as it has nothing to do with w.
        let exponent = reaches[2].to_bits() >> 23;
        let scale_z = if perspective { 1.0 } else { f32::from_bits(254_u32.checked_sub(exponent)? << 23) };
        let scales = [scale_x * halves[0], -scale_y * halves[1], scale_z];
        let mut greatest = if perspective { 0.0 } else { 1.0 };
        for (reach, scale) in reaches.into_iter().zip(scales) {
            let reach = reach * scale.abs();
            if !reach.is_finite() {
                return None;
            }
            greatest = if reach > greatest { reach } else { greatest };
        }
        // In parallel projection 1 must not be lost beside the other coordinates.
        #[expect(clippy::cast_precision_loss, reason = "at most 2^22")]
        let half = sizes[0].max(sizes[1]) as f32;
        if !perspective && greatest * half > 1_048_576.0 {
            return None;
        }
        let units = 127 + 29 - (greatest.to_bits() >> 23).cast_signed();
        let guard = viewport.guard();
        if !(greatest > 0.0 && (-40..=60).contains(&units) && guard.x >= 1.0 && guard.y >= 1.0) {
            return None;
        }
        let row = |axis: [f32; 3], origin: f32, scale: f32| Row {
            factors: axis.map(|c| scaled(c * scale, units + 16)),
            // Three products are rounded down.
            origin: scaled(origin * scale, units) + 1,
        };
        let planes = [projection.near() * scale_z, projection.far() * scale_z];
        let [near, far] = planes.map(|z| scaled(z, units));
        let near = if perspective { near.max(1) } else { near };
        let depth = if perspective {
            Depth::hyperbolic(planes, units, depth_bits, reversed)?
        } else {
            Depth::linear(planes, greatest, units, depth_bits, reversed)?
        };
        let cube = sides == Sides::Cube;
        let sure = [near.saturating_add(DOUBT), far.saturating_sub(DOUBT)];
        let shifts = bits.map(|bits| SCREEN.cast_unsigned() - bits);
        let inside = |bound: f32, half: f32| scaled(bound * half, 8) - 2;
        Some(Self {
            rows: [
                row(axes[0], origin[0], scales[0]),
                row(axes[1], origin[1], scales[1]),
                row(axes[2], origin[2], scales[2]),
            ],
            planes: [near, far],
            inner: if cube { [i32::MAX, i32::MIN] } else { sure },
            cube,
            one: scaled(1.0, units),
            sides: halves.map(|half| scaled(half, SCREEN)),
            halves: shifts.map(|shift| 1 << (shift - 1)),
            shifts,
            center: viewport.center(subpixel),
            depth,
            exponent: (127 + units - 32).cast_unsigned(),
            guard: [inside(guard.x, halves[0]), inside(guard.y, halves[1])],
        })
    }

    /// The place of a vertex in the view; none of one that is [beyond](Self::beyond) it.
    #[inline(always)]
    pub(crate) fn place<Pr: Projection>(&self, projection: &Pr, position: [i16; 3]) -> Option<Place> {
        // One after the other: all their factors at once do not fit in registers.
        let [right, down, forward] = &self.rows;
        let z = forward.at(position);
        let w = if projection.is_perspective() { z } else { self.one };
        let [near, far] = self.inner;
        if z < near || z > far {
            return None;
        }
        let within = |x: i32, side: i32| x.wrapping_add(side).cast_unsigned() <= side.cast_unsigned() << 1;
        let x = right.at(position);
        if !within(x, w) {
            return None;
        }
        let y = down.at(position);
        if !within(y, w) {
            return None;
        }
        let (normalizing, per_w) = per(w);
        let [x, y] = map2([x, y], |x| high_signed(x << normalizing, per_w));
        if !(within(x, self.sides[0]) && within(y, self.sides[1])) {
            return None;
        }
        let snapped =
            |axis: usize, x: i32| ((x + self.halves[axis]) >> self.shifts[axis]) + self.center[axis];
        let place = [snapped(0, x), snapped(1, y)];
        Some(Place { outside: 0, place, depths: self.depths(projection, z, normalizing, per_w) })
    }

    /// zs and q of a vertex between the planes.
    #[inline(always)]
    fn depths<Pr: Projection>(&self, projection: &Pr, z: i32, normalizing: u32, per_w: i32) -> [u32; 2] {
        let Depth { factor, shift, .. } = self.depth;
        let part = if projection.is_perspective() {
            (high_signed(per_w, factor) << 1) >> shift.wrapping_sub(normalizing).min(31)
        } else {
            high_signed(z.wrapping_sub(self.depth.zero) << shift, factor) >> (SCREEN - DEPTH)
        };
        let q = (per_w >> 7).cast_unsigned().wrapping_add((self.exponent + normalizing) << 23);
        [self.depth.at(part), q]
    }

    /// Whether a vertex is so near to a side of the view that floats may see it on the other.
    fn doubtful(&self, [x, y]: [i32; 2], w: i32) -> bool {
        let near = |x: i32, side: i32| {
            let beyond = (i64::from(x.unsigned_abs()) << SCREEN) - i64::from(side) * i64::from(w);
            beyond.unsigned_abs() <= u64::from(DOUBT.cast_unsigned()) << SCREEN
        };
        near(x, self.sides[0]) || near(y, self.sides[1])
    }

    /// The place of a vertex that is beyond a plane, or so near to one that its triangles are clipped.
    #[cold]
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "within the guard band")]
    pub(crate) fn beyond<Pr: Projection>(&self, projection: &Pr, position: [i16; 3]) -> Place {
        let [x, y, z] = map3(self.rows, |row| row.at(position));
        let w = if projection.is_perspective() { z } else { self.one };
        let [near, far] = self.planes;
        let wide = i64::from(w);
        // A vertex next to a plane is where floats have it: a bit would drop triangles that lie in the plane.
        let [at_near, at_far] =
            map2(self.planes, |plane| z.wrapping_sub(plane).unsigned_abs() < DOUBT.unsigned_abs());
        let near = if z < near && !at_near { outside::NEAR } else { 0 };
        let far = if z > far && !at_far { outside::FAR } else { 0 };
        let sides =
            bits_beside([x, y].map(|x| i64::from(x) << SCREEN), self.sides.map(|x| i64::from(x) * wide));
        let is_far = |x: i32, guard: i32| i64::from(x.unsigned_abs()) << 8 > i64::from(guard) * wide;
        let doubtful = at_near || at_far || (self.cube && self.doubtful([x, y], w));
        let guard = doubtful || is_far(x, self.guard[0]) || is_far(y, self.guard[1]);
        let outside = near | far | sides | if guard { outside::GUARD } else { 0 };
        if outside & (outside::NEAR | outside::FAR | outside::GUARD) != 0 {
            return Place { outside, place: [0; 2], depths: [0; 2] };
        }
        let (normalizing, per_w) = per(w);
        let snapped = |axis: usize, x: i32| {
            let x = (i64::from(x) * i64::from(per_w)) >> (32 - normalizing);
            ((x + i64::from(self.halves[axis])) >> self.shifts[axis]) as i32 + self.center[axis]
        };
        let place = [snapped(0, x), snapped(1, y)];
        Place { outside, place, depths: self.depths(projection, z, normalizing, per_w) }
    }
}

/// The bits that a positive `w` is to be shifted to the left, and 2^61 over what it then is.
#[inline(always)]
fn per(w: i32) -> (u32, i32) {
    // Never 32 zeros, as compilers see.
    let normalizing = (w.cast_unsigned() << 1 | 1).leading_zeros();
    (normalizing, reciprocal_signed(w << normalizing))
}

/// The bits of [`outside`] of a place to the right and down, between these sides.
#[inline(always)]
fn bits_beside([x, y]: [i64; 2], [side, level]: [i64; 2]) -> u32 {
    let bit = |beside: bool, bit: u32| if beside { bit } else { 0 };
    bit(x < -side, outside::LEFT)
        | bit(x > side, outside::RIGHT)
        | bit(y < -level, outside::ABOVE)
        | bit(y > level, outside::BELOW)
}

#[cfg(test)]
mod tests;
