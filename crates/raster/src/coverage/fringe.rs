//! The colours of pixels that are covered, but not at their centre.

use super::edge::Edge;
use super::pieces::Piece;
use super::{Coverage, Part, misses, seen};
use crate::color::ColorFormat;
use crate::counters::Counters;
use crate::depth::DepthFormat;
use crate::draw::Paint;
use crate::fragment::FragmentStage;
use crate::interpolation::Interpolation;
use crate::pixels::narrowed;
use crate::target::Target;
use crate::triangle::{Corner, Corners, in_order};
use alberti_math::lanes::{Lanes, One};
use alberti_math::{Mode, Varying, map3};
use core::ops::Range;

impl<F: Copy, P: Interpolation> Paint<F, P> {
    /// Draws those pixels on the edges of a triangle that are covered, but not at their centre: where the silhouette
    /// leaves nothing else to draw. Each has the depth and the attributes of the edge, in the middle of what the pixel
    /// has of it, and is drawn if it is seen. The derivatives of attributes are 0 there, as on lines.
    ///
    /// # Precision
    /// Depth and attributes are those of a [`line`](Self::line), at a place along the edge that is a subpixel off at
    /// most.
    ///
    /// # Cost
    /// That of [`cover`](Self::cover), but for a load instead of sums at each pixel on an edge, and of a line for those
    /// that are drawn.
    pub fn fringe<V, C, D, K>(
        &self,
        target: &mut Target<'_, C, D>,
        coverage: &Coverage<'_>,
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) where
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let (fixed, bits) = (const { <P::Lanes<One> as Lanes>::FIXED }, self.subpixel.bits());
        let limits = coverage.within(target);
        let places = map3(corners, |corner| corner.place(fixed));
        let Some(area) = seen(&places, self.cull, bits) else { return };
        if misses(&places, bits, &limits) || !coverage.may_have_fringe(&places, bits, &limits) {
            return;
        }
        let flat = corners[0];
        // In an order that does not depend on how the triangle was given.
        let (places, corners) = in_order(places, corners, area);
        for [k, l] in [[0, 1], [1, 2], [2, 0]] {
            let (edge, down) = Edge::new([places[k], places[l]]);
            let (upper, lower) = if down { (k, l) } else { (l, k) };
            edge.pieces(bits, &limits, |Piece { place, middle, .. }| {
                let Some(middle) = middle else { return };
                if Part(coverage.cells.word(place)).is_fringe() {
                    let upper = with_flat(corners[upper], flat);
                    let [near, far] = edge.weights(middle, bits);
                    let pixel = [(place, far)].into_iter();
                    self.between(target, [&upper, corners[lower]], [far, near + far], pixel, counters);
                }
            });
        }
    }
}

impl Coverage<'_> {
    /// Whether a triangle may have pixels to be drawn: loads alone tell it of small ones, of which most have none.
    fn may_have_fringe(&self, corners: &Corners, bits: u32, limits: &[Range<i32>; 2]) -> bool {
        let [columns, rows] = [0, 1].map(|axis: usize| {
            let [a, b, c] = corners.map(|corner| corner[axis] >> bits);
            narrowed(&limits[axis], a.min(b).min(c)..a.max(b).max(c) + 1)
        });
        if columns.len() > 16 || rows.len() > 16 {
            return true;
        }
        rows.into_iter().any(|row| {
            let first = self.cells.index([columns.start, row]).unwrap_or(usize::MAX);
            let words = self.cells.words.get(first..).unwrap_or_default();
            words.iter().take(columns.len()).any(|word| Part(*word).is_fringe())
        })
    }
}

/// The corner with the flat components of another.
fn with_flat<V: Varying>(corner: &Corner<V>, flat: &Corner<V>) -> Corner<V> {
    let both = V::zip(&corner.components, &flat.components);
    let components = V::map_by_mode(&both, &|mode, (own, flat): (u32, u32)| {
        if mode == Mode::Flat { flat } else { own }
    });
    Corner { components, ..*corner }
}
