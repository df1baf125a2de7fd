//! Lines and points: a pixel wide, or a square, with the depth test and the fragment stage of triangles.

mod segment;

use crate::bias::biased_line;
use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::draw::Paint;
use crate::fragment::{FragmentStage, Fragments};
use crate::interpolation::Interpolation;
use crate::target::Target;
use crate::triangle::{Corner, Outcome};
use alberti_math::lanes::{Lanes, One, OneFixed};
use alberti_math::{Gradient, Varying};
use core::ops::Range;
use segment::{FixedSegment, FloatSegment, Segment, Still, Walk, length, misses};

impl<F: Copy, P: Interpolation> Paint<F, P> {
    /// Draws the line from one corner to another into a target, one sample at a time.
    ///
    /// A pixel belongs to it by the diamond-exit rule (Direct3D 11, 3.4.3): if the line leaves the diamond |x| + |y| <
    /// ½ about its centre. So a line has one pixel a column, or a row where it is steep. Where another goes on in its
    /// direction there is neither a gap nor a pixel drawn twice. Ties go to lower edges and corners, of steep lines to
    /// right corners as well.
    ///
    /// # Precision
    /// Pixels are exact. Attributes and depth are those of the point of the line in the pixel's column, or row, with
    /// perspective by all policies. In floats they are within 9ε of the greater end. In fixed point attributes are
    /// within a step of 2^-15, depth within one of 2^-31, and both within 2^-28 of the difference between the ends.
    ///
    /// # Cost
    /// A line out of the target: four comparisons. Another: a division of 32 bits, one more for each side of the target
    /// that it crosses, and one in floats or a reciprocal by a table. Lines of more than 2,896 pixels (`Sub8`) may
    /// divide in 64 bits. A pixel: for its depth a product and a sum, in fixed point a sum of 64 bits. For attributes
    /// that are hyperbolic it is a division, in fixed point a reciprocal by a table and products of 64 bits.
    #[inline(always)]
    pub fn line<V, C, D, K>(&self, target: &mut Target<'_, C, D>, corners: [&Corner<V>; 2], counters: &mut K)
    where
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let fixed = const { <P::Lanes<One> as Lanes>::FIXED };
        if misses(corners.map(|corner| corner.place(fixed)), self.subpixel.bits(), &target.limits()) {
            counters.rasterized(Outcome::Missed);
        } else {
            self.line_within(target, corners, counters);
        }
    }

    /// The same for one that may have pixels in the target.
    #[inline(never)]
    fn line_within<V, C, D, K>(
        &self,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 2],
        counters: &mut K,
    ) where
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let fixed = const { <P::Lanes<One> as Lanes>::FIXED };
        let places = corners.map(|corner| corner.place(fixed));
        let pixels = Walk::new(places, self.subpixel.bits(), &target.limits());
        self.between(target, corners, [pixels.far(), length(places)], pixels, counters);
    }

    /// Draws pixels in a row between two corners, of which it is known how far they are of the `length` from one to the
    /// other: the first so far.
    #[inline(always)]
    pub(crate) fn between<V, C, D, K>(
        &self,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 2],
        [first, length]: [i32; 2],
        pixels: impl Iterator<Item = ([i32; 2], i32)>,
        counters: &mut K,
    ) where
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let (fixed, bits) = (const { <P::Lanes<One> as Lanes>::FIXED }, self.subpixel.bits());
        let moved;
        let corners = if const { D::BIASED } {
            moved = biased_line(corners, (fixed, bits), target.depth_format());
            moved.each_ref()
        } else {
            corners
        };
        // Constants in blocks of their own, so that one way alone is compiled.
        if const { <P::Lanes<One> as Lanes>::FIXED } {
            let segment = FixedSegment::new(corners, length, [first, 1 << bits]);
            self.along(OneFixed, target, pixels, segment, counters);
        } else {
            self.along(One, target, pixels, FloatSegment::new(corners, length), counters);
        }
    }

    /// Draws a square of `size` pixels a side about a corner, all of which have the corner's attributes and depth.
    ///
    /// A pixel belongs to it if its centre is within, on the left or on the top edge. So a point of size 1 is one
    /// pixel.
    ///
    /// # Precision
    /// Pixels, depth and attributes are exact: those of the corner, to the bit.
    ///
    /// # Cost
    /// A point: shifts and sums, without a division. A pixel: its depth test and its fragment.
    pub fn point<V, C, D, K>(
        &self,
        target: &mut Target<'_, C, D>,
        corner: &Corner<V>,
        size: u16,
        counters: &mut K,
    ) where
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let fixed = const { <P::Lanes<One> as Lanes>::FIXED };
        let bits = self.subpixel.bits();
        let half = 1 << bits >> 1;
        // Centres are a half from the left; the side is half of the size from the middle.
        let first = |c: i32| (c - half * i32::from(size) - half + (1 << bits) - 1) >> bits;
        let [limits_x, limits_y] = target.limits();
        let within = |first: i32, limits: &Range<i32>| {
            first.max(limits.start)..(first + i32::from(size)).min(limits.end)
        };
        let [x, y] = corner.place(fixed);
        let (columns, rows) = (within(first(x), &limits_x), within(first(y), &limits_y));
        if rows.is_empty() || columns.is_empty() {
            return counters.rasterized(Outcome::Missed);
        }
        let moved;
        let corner = if const { D::BIASED } {
            [moved, _] = biased_line([corner; 2], (fixed, bits), target.depth_format());
            &moved
        } else {
            corner
        };
        let pixels = rows.flat_map(|row| columns.clone().map(move |column| ([column, row], 0)));
        if const { <P::Lanes<One> as Lanes>::FIXED } {
            self.along(OneFixed, target, pixels, Still::new(corner), counters);
        } else {
            self.along(One, target, pixels, Still::new(corner), counters);
        }
    }

    /// Draws the fragments of a segment at pixels, of which it is known how far along it they are.
    #[inline(never)]
    fn along<L, V, C, D, K>(
        &self,
        lanes: L,
        target: &mut Target<'_, C, D>,
        pixels: impl Iterator<Item = ([i32; 2], i32)>,
        mut segment: impl Segment<L, V>,
        counters: &mut K,
    ) where
        L: Lanes,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let (color_format, depth_format) = (target.color_format(), target.depth_format());
        let (mut covered, mut written) = (0, 0);
        for (place, far) in pixels {
            let [column, row] = place;
            let Some((color, depth)) = target.pixel(row, column) else { continue };
            counters.touched(Outcome::Drawn, || [column..column + 1, row..row + 1]);
            covered += 1;
            // As many lanes as one.
            let one = |x: &mut C::Pixel| lanes.each(|_| *x);
            let mut pixel = one(color);
            let mut stored = lanes.each(|_| *depth);
            let zs = depth_format.encode_lanes(lanes, segment.depth(lanes, far));
            let seen = depth_format.seen(lanes, &zs, &stored, lanes.mask(1));
            if lanes.bits(seen) == 0 {
                continue;
            }
            let varying = segment.attributes(lanes, far);
            let steady = V::map(&varying, &|_| lanes.splat(0.0));
            let gradient = Gradient { dx: steady, dy: steady };
            let in_row = const { F::BY_ROWS }.then(|| self.stage.in_row(row));
            let stage = in_row.as_ref().unwrap_or(&self.stage);
            let (word, kept) = stage.shade(&Fragments { lanes, varying, gradient, mask: seen, place });
            let kept = kept & seen;
            color_format.store::<L, F::Color>(lanes, word, kept, place, &mut pixel);
            depth_format.keep(lanes, &zs, kept, &mut stored);
            if let (Some(pixel), Some(kept)) = (pixel.as_ref().first(), stored.as_ref().first()) {
                (*color, *depth) = (*pixel, *kept);
            }
            written += lanes.bits(kept);
        }
        counters.span(covered, written);
        counters.rasterized(if covered > 0 { Outcome::Drawn } else { Outcome::Missed });
    }
}

#[cfg(test)]
mod tests;
