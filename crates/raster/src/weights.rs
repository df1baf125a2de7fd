//! Edge functions along a row, rounded once to `f32`, for several lanes. Steps take no integers of 64 bits, nor `f64`.
//!
//! ```text
//!   E = A + B    A: a multiple of 2^b     |A| <= 2^(24 + b)
//!                B: the rest              |B| <= 2^24
//! ```
//!
//! Both parts are numbers without rounding, and so are sums of such parts within these limits. Only A + B is rounded.

use crate::edge::{Edge, EdgeInt};
use alberti_math::lanes::Lanes;

/// Two parts of each edge function at the first of several lanes.
pub(crate) type Parts = [[f32; 2]; 3];

/// The increments of a triangle's edge functions in parts, from lane to lane and to the next group of lanes.
#[derive(Clone, Copy)]
pub(crate) struct Weights<L: Lanes> {
    lanes: L,
    /// The b of above.
    bits: u32,
    offsets: [[L::Number; 2]; 3],
    steps: Parts,
}

impl<L: Lanes> Weights<L> {
    /// The increments of these edges, of a triangle with this doubled area.
    ///
    /// Values in the triangle are at most the area, and 2^37 more in lanes beside it. A target's samples lie in a
    /// quarter of the guard band's square, where they are below 2^48: so 24 bits suffice.
    #[inline(always)]
    pub(crate) fn new<I: EdgeInt>(lanes: L, edges: &[Edge<I>; 3], doubled_area: i64) -> Self {
        let bits = (41 - (doubled_area + (1 << 37)).leading_zeros()).min(24);
        let [a, b, c] = edges;
        let offsets = |e: &Edge<I>| lanes.long_parts(e.step_x.to_i64(), bits);
        let step = |e: &Edge<I>| parts(e.step_x.to_i64() * i64::from(L::STEP), bits);
        Self {
            lanes,
            bits,
            offsets: [offsets(a), offsets(b), offsets(c)],
            steps: [step(a), step(b), step(c)],
        }
    }

    /// The number of groups for which parts can be followed. B is at most half of 2^b in the first lane, and each step
    /// adds as much, as does the way to another lane.
    #[inline(always)]
    pub(crate) fn groups(&self) -> u32 {
        (1 << (25 - self.bits)) - 1
    }

    /// Values in parts.
    #[inline(always)]
    pub(crate) fn parts<I: EdgeInt>(&self, [a, b, c]: [I; 3]) -> Parts {
        let of = |value: I| parts(value.to_i64(), self.bits);
        [of(a), of(b), of(c)]
    }

    /// The functions in all lanes.
    #[inline(always)]
    pub(crate) fn at(&self, [a, b, c]: &Parts) -> [L::Number; 3] {
        let lanes = self.lanes;
        let [of_a, of_b, of_c] = self.offsets;
        let sum =
            |x: &[f32; 2], of: [L::Number; 2]| (of[0] + lanes.splat(x[0])) + (of[1] + lanes.splat(x[1]));
        [sum(a, of_a), sum(b, of_b), sum(c, of_c)]
    }

    /// The parts a group of lanes farther.
    #[inline(always)]
    pub(crate) fn next(&self, [a, b, c]: &Parts) -> Parts {
        let [by_a, by_b, by_c] = &self.steps;
        let sum = |x: &[f32; 2], by: &[f32; 2]| [x[0] + by[0], x[1] + by[1]];
        [sum(a, by_a), sum(b, by_b), sum(c, by_c)]
    }
}

/// The nearest multiple of 2^`bits`, and the rest.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "up to 24 bits each")]
fn parts(value: i64, bits: u32) -> [f32; 2] {
    let rest = value << (64 - bits) >> (64 - bits);
    [(value - rest) as f32, rest as f32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use alberti_math::for_lanes;
    use alberti_math::lanes::{Floating, Machine};

    /// Edge functions of triangles up to the whole guard band, along rows of the widest target.
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    fn sums_are_the_nearest_numbers<L: Floating>(lanes: L) {
        let heights = [1, 255, 70_001, (1 << 24) - 1];
        for (power, height) in (16..48).flat_map(|power| heights.map(|height| (power, height))) {
            let (area, step): (i64, i64) = ((1 << power) + 12_345, height << 8);
            let edge = |value, step_x| Edge { value, step_x, step_y: 0, bias: 0 };
            let edges = [edge(area / 3, step), edge(area, -step), edge(area / 7, 0)];
            let weights = Weights::new(lanes, &edges, area);
            let at = |column: i64| edges.map(|edge: Edge<i64>| edge.value + edge.step_x * column);
            let (mut parts, mut groups) = (weights.parts(at(0)), weights.groups());
            for column in (0..1 << 14).step_by(L::COUNT) {
                let found = weights.at(&parts).map(|numbers| lanes.store(numbers));
                for lane in 0..L::COUNT {
                    let exact = at(column + i64::try_from(lane).expect("small"));
                    for (exact, found) in exact.iter().zip(&found) {
                        let inside = (0..=area).contains(exact);
                        assert!(
                            !inside || found.as_ref()[lane] == *exact as f32,
                            "{exact} of {area}, {column}"
                        );
                    }
                }
                groups -= 1;
                parts = weights.next(&parts);
                if groups == 0 {
                    groups = weights.groups();
                    parts = weights.parts(at(column + i64::from(L::STEP)));
                }
            }
        }
    }

    #[test]
    fn parts_sum_to_the_nearest_numbers() {
        for machine in Machine::all() {
            for_lanes!(machine, lanes => {
                if lanes.bits(lanes.mask(2)) == 2 {
                    sums_are_the_nearest_numbers(lanes);
                    sums_are_the_nearest_numbers(lanes.wide());
                }
            });
        }
    }
}
