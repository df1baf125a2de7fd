//! From a span of covered samples to pixels: weights, depth, attributes, colour, as many samples at a time as there are
//! lanes. This is the loop in which the time goes.

use crate::color::{ColorFormat, Store};
use crate::depth::DepthFormat;
use crate::edge::EdgeInt;
use crate::exact::Exact;
use crate::fragment::FragmentStage;
use crate::lanes::Lanes;
use crate::triangle::Vertex;
use alberti_math::{Subpixel, Varying, hull3};

/// What a triangle looks like: what is interpolated over it, and the stage that makes colours of that.
pub(crate) struct Painter<'a, L: Lanes, V: Varying, F> {
    /// zs over the doubled area, so that weights need not be normalised.
    zs: [L; 3],
    nearest_farthest: [L; 2],
    attributes: Exact<L, V>,
    fragment: &'a F,
}

/// Pixels from some place on, with their depths; as many of the one as of the other.
pub(crate) struct Rest<'a, C: ColorFormat, D: DepthFormat> {
    pub(crate) color: &'a mut [C::Pixel],
    pub(crate) depth: &'a mut [D::Stored],
}

impl<'a, L: Lanes, V: Varying, F: FragmentStage<V>> Painter<'a, L, V, F> {
    #[inline(always)]
    pub(crate) fn new<S: Subpixel>(
        [a, b, c]: [&Vertex<S, V>; 3],
        doubled_area: i64,
        fragment: &'a F,
    ) -> Self {
        let area = doubled_area.to_f32();
        let [lo, hi] = hull3([a.zs, b.zs, c.zs]);
        Self {
            zs: [L::splat(a.zs / area), L::splat(b.zs / area), L::splat(c.zs / area)],
            nearest_farthest: [L::splat(lo), L::splat(hi)],
            attributes: Exact::new([a.q, b.q, c.q], [a.varying, b.varying, c.varying]),
            fragment,
        }
    }

    /// Fills the first `covered` samples and counts those written. `edges` are the edge functions at the first. The last
    /// lanes may look at pixels beyond the span, which they leave alone.
    #[inline(always)]
    pub(crate) fn span<I, C, D>(
        &self,
        rest: &mut Rest<'_, C, D>,
        covered: u32,
        edges: [I; 3],
        steps: [I; 3],
    ) -> u32
    where
        I: EdgeInt,
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let mut e0 = L::edge::<I>(edges[0], steps[0]);
        let mut e1 = L::edge::<I>(edges[1], steps[1]);
        let mut e2 = L::edge::<I>(edges[2], steps[2]);
        let (mut at, mut left, mut written) = (0, covered as usize, 0);
        loop {
            let weights = [L::weight::<I>(e0), L::weight::<I>(e1), L::weight::<I>(e2)];
            let lanes = if left < L::COUNT { (1 << left) - 1 } else { (1 << L::COUNT) - 1 };
            let end = at + L::COUNT;
            written += match (rest.color.get_mut(at..end), rest.depth.get_mut(at..end)) {
                (Some(color), Some(depth)) => self.lanes(&mut Rest::<C, D> { color, depth }, lanes, weights),
                _ => self.end(rest, at, lanes, weights),
            };
            if left <= L::COUNT {
                return written;
            }
            left -= L::COUNT;
            at = end;
            e0 = L::advance::<I>(e0, steps[0]);
            e1 = L::advance::<I>(e1, steps[1]);
            e2 = L::advance::<I>(e2, steps[2]);
        }
    }

    /// Fills the last samples of a band, fewer than there are lanes, by way of a copy.
    #[cold]
    #[inline(never)]
    fn end<C, D>(&self, rest: &mut Rest<'_, C, D>, at: usize, lanes: u32, weights: [L; 3]) -> u32
    where
        C: Store<F::Color>,
        D: DepthFormat,
    {
        let (Some(color), Some(depth)) = (rest.color.get_mut(at..), rest.depth.get_mut(at..)) else {
            return 0;
        };
        let (Some(&first_color), Some(&first_depth)) = (color.first(), depth.first()) else { return 0 };
        let (mut colors, mut depths) = ([first_color; 4], [first_depth; 4]);
        colors.iter_mut().zip(&*color).for_each(|(copy, &pixel)| *copy = pixel);
        depths.iter_mut().zip(&*depth).for_each(|(copy, &stored)| *copy = stored);
        let written =
            self.lanes(&mut Rest::<C, D> { color: &mut colors, depth: &mut depths }, lanes, weights);
        color.iter_mut().zip(colors).for_each(|(pixel, copy)| *pixel = copy);
        depth.iter_mut().zip(depths).for_each(|(stored, copy)| *stored = copy);
        written
    }

    /// Fills those samples whose bits are set in `lanes`. `weights` are the edge functions.
    #[inline(always)]
    fn lanes<C, D>(&self, pixels: &mut Rest<'_, C, D>, lanes: u32, weights: [L; 3]) -> u32
    where
        C: Store<F::Color>,
        D: DepthFormat,
    {
        // The screen depth is linear on the screen, and kept within that of the vertices.
        let [nearest, farthest] = self.nearest_farthest;
        let zs = weights[0] * self.zs[0] + weights[1] * self.zs[1] + weights[2] * self.zs[2];
        let zs = zs.max(nearest).min(farthest);
        // One sample after the other instead of in a loop, so that each takes its lane from a register.
        let mut seen = sees::<0, L, D>(zs, pixels.depth);
        if L::COUNT == 4 {
            seen |= sees::<1, L, D>(zs, pixels.depth);
            seen |= sees::<2, L, D>(zs, pixels.depth);
            seen |= sees::<3, L, D>(zs, pixels.depth);
        }
        seen &= lanes;
        if seen == 0 {
            return 0;
        }
        let varyings = self.attributes.at(weights);
        let mut written = self.shade::<0, C, D>(pixels, seen, zs, &varyings);
        if L::COUNT == 4 {
            written += self.shade::<1, C, D>(pixels, seen, zs, &varyings);
            written += self.shade::<2, C, D>(pixels, seen, zs, &varyings);
            written += self.shade::<3, C, D>(pixels, seen, zs, &varyings);
        }
        written
    }

    /// Shades sample `K` if it is seen, and counts whether it was written.
    #[inline(always)]
    fn shade<const K: usize, C, D>(
        &self,
        pixels: &mut Rest<'_, C, D>,
        seen: u32,
        zs: L,
        varyings: &V::Of<L>,
    ) -> u32
    where
        C: Store<F::Color>,
        D: DepthFormat,
    {
        if seen >> K & 1 == 0 {
            return 0;
        }
        let varying = V::from_components(&V::map(varyings, &|lanes: L| lanes.lane(K)));
        let place = (pixels.color.get_mut(K), pixels.depth.get_mut(K));
        let (Some(color), (Some(pixel), Some(stored))) = (self.fragment.shade(varying), place) else {
            return 0;
        };
        *stored = D::encode(zs.lane(K));
        *pixel = C::pixel(color);
        1
    }
}

/// Bit `K` if there is a sample `K` and it is seen in front of what is stored.
#[inline(always)]
fn sees<const K: usize, L: Lanes, D: DepthFormat>(zs: L, depth: &[D::Stored]) -> u32 {
    u32::from(depth.get(K).is_some_and(|&old| D::nearer(D::encode(zs.lane(K)), old))) << K
}
