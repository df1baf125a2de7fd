//! The order of the corners and the edges of several triangles at once, each in a lane.

use crate::edge::{Edge, FITS_I32};
use crate::interpolation::Oriented;
use crate::triangle::Corner;
use crate::unsnapped::LARGE;
use alberti_math::lanes::Lanes;
use alberti_math::{Fixed, Varying, map2, map3};
use core::ops::Range;

/// A triangle that waits for others, not culled, with twice its signed area, positive if it is clockwise.
pub(crate) type Waiting<'c, V> = ([&'c Corner<V>; 3], i64);

/// The columns of the widest box for which testing all samples is cheaper than finding where the edges cross the rows.
pub(crate) const NARROW: u32 = 32;

/// Edge functions of narrow boxes that are not large fit `i32`, see [`FITS_I32`]. That is so in them, in the pixel
/// around them, and from the lanes' first column on. Twice as many columns as a narrow box has, 256 subpixels each, are
/// more than all that.
const _: () = assert!(NARROW as i64 * 3 / 2 * 256 * (LARGE as i64 + 1) * 256 <= FITS_I32);
// A box that is filled by masks is not of a large triangle.
const _: () = assert!(NARROW.cast_signed() < LARGE);

/// As many triangles as there are lanes: their boxes, their corners in [order](crate::triangle::in_order), and their
/// edges in words of 32 bits.
///
/// Its alignment is that of the stack frame in which a kernel holds it, and so of the vector registers that the kernel
/// keeps there. Otherwise they are aligned to 16 bytes, and it depends on where a program's stack begins how they lie.
/// In a few of a hundred runs one that each sample needs is across two pages, which takes 1.8 times as long.
#[repr(align(64))]
pub(crate) struct Setups<L: Lanes> {
    /// The ways to fill the triangles.
    ways: L::Each<u32>,
    /// The numbers of the corners that are the first, the second and the third.
    order: [L::Each<u32>; 3],
    /// The columns of the box, and its rows within the target: first and end.
    ranges: [L::Each<u32>; 4],
    /// Of the edges opposite these, the value at the box's first row and the lanes' first column, the steps to the
    /// right and down, the bias. Only narrow boxes have them.
    edges: [[L::Each<u32>; 4]; 3],
}

/// The way to fill a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// None: its box has no sample within the target.
    Missed,
    /// By testing all samples of a box that is narrow and low, within the target's columns, and in one run.
    Masks,
    /// By spans.
    Spans,
}

/// The columns and rows of three corners as bits of [`Fixed`], and whether they are turned.
type Words<L> = [<L as Lanes>::Each<u32>; 7];

impl<L: Lanes> Setups<L> {
    /// The setup of triangles with so many bits of subpixels, for a target with these columns and rows and a policy
    /// with such runs.
    #[inline(always)]
    pub(crate) fn new<V: Varying>(
        lanes: L,
        triangles: &L::Each<Option<Waiting<'_, V>>>,
        bits: u32,
        limits: &[Range<i32>; 2],
        run: i32,
    ) -> Self {
        let mut words = [lanes.each(|_| 0); 7];
        lanes.each(
            #[inline(always)]
            |k| {
                if let Some(Some(([a, b, c], area))) = triangles.as_ref().get(k) {
                    let [[ax, ay], [bx, by], [cx, cy]] =
                        map3([a, b, c], |corner| map2(corner.unsnapped(), Fixed::to_bits));
                    for (words, word) in words.iter_mut().zip([ax, ay, bx, by, cx, cy, u32::from(*area < 0)])
                    {
                        if let Some(to) = words.as_mut().get_mut(k) {
                            *to = word;
                        }
                    }
                }
            },
        );
        Self::of_words(lanes, &words, bits, limits, run)
    }

    /// The same, once for all kinds of vertices: a copy in each kernel would take a quarter of the time to compile it.
    #[inline(never)]
    fn of_words(lanes: L, words: &Words<L>, bits: u32, limits: &[Range<i32>; 2], run: i32) -> Self {
        lanes.vectorize(
            #[inline(always)]
            || Self::in_lanes(lanes, words, bits, limits, run),
        )
    }

    #[inline(always)]
    fn in_lanes(lanes: L, words: &Words<L>, bits: u32, limits: &[Range<i32>; 2], run: i32) -> Self {
        let [ax, ay, bx, by, cx, cy, turned] = words;
        let [a, b, c] = [corner(lanes, [ax, ay], 0), corner(lanes, [bx, by], 1), corner(lanes, [cx, cy], 2)];
        let [columns, rows] = limits;
        let ([left, right], _) = samples(lanes, [a[0], b[0], c[0]], bits);
        let ([top, bottom], height) = samples(lanes, [a[1], b[1], c[1]], bits);
        let [top, bottom] = [greater(lanes, top, rows.start), lesser(lanes, bottom, rows.end)];
        let visible = [greater(lanes, left, columns.start), lesser(lanes, right, columns.end)];
        let some = less(lanes, top, bottom) & less(lanes, visible[0], visible[1]);
        let first = left & lanes.word(!(L::STEP - 1).cast_unsigned());
        let whole = lanes.equal_words(left, visible[0]) & lanes.equal_words(right, visible[1]);
        let runs = (left ^ (right - lanes.word(1))) & lanes.word(!(run - 1).cast_unsigned());
        let narrow = lanes.less_words(right - first, lanes.word(NARROW + 1))
            & lanes.less_words(height, lanes.word((LARGE + 1).cast_unsigned() << bits))
            & lanes.equal_words(runs, lanes.word(0));
        let [missed, masks, spans] = [Way::Missed, Way::Masks, Way::Spans].map(|way| lanes.word(way as u32));
        let way = lanes.select_words(narrow & whole, masks, spans);
        let [p, q, r] = in_order(lanes, [a, b, c], lanes.load_words(turned));
        let sample = [middle(lanes, first, bits), middle(lanes, top, bits)];
        Self {
            ways: lanes.store_words(lanes.select_words(some, way, missed)),
            order: [lanes.store_words(p[2]), lanes.store_words(q[2]), lanes.store_words(r[2])],
            ranges: [
                lanes.store_words(left),
                lanes.store_words(right),
                lanes.store_words(top),
                lanes.store_words(bottom),
            ],
            edges: [
                edge(lanes, [q, r], sample, bits),
                edge(lanes, [r, p], sample, bits),
                edge(lanes, [p, q], sample, bits),
            ],
        }
    }

    /// The way to fill triangle `k`.
    #[inline(always)]
    pub(crate) fn way(&self, k: usize) -> Way {
        match word(&self.ways, k) {
            0 => Way::Missed,
            1 => Way::Masks,
            _ => Way::Spans,
        }
    }

    /// The columns and the rows of triangle `k`.
    #[inline(always)]
    pub(crate) fn columns_and_rows(&self, k: usize) -> [Range<i32>; 2] {
        let [left, right, top, bottom] = &self.ranges;
        [word(left, k)..word(right, k), word(top, k)..word(bottom, k)]
    }

    /// The edges of triangle `k`.
    #[inline(always)]
    pub(crate) fn edges(&self, k: usize) -> [Edge<i32>; 3] {
        let [a, b, c] = &self.edges;
        [edge_of(a, k), edge_of(b, k), edge_of(c, k)]
    }

    /// Triangle `k`, whose vertices these are, for interpolation.
    #[inline(always)]
    pub(crate) fn oriented<'a, V: Varying>(
        &self,
        k: usize,
        (vertices, area): &Waiting<'a, V>,
        bits: u32,
    ) -> Oriented<'a, V> {
        let [a, b, c] = *vertices;
        let vertices = map3(self.order.each_ref(), |order| match word(order, k) {
            0 => a,
            1 => b,
            _ => c,
        });
        let corners = map3(vertices, |corner| corner.place(false));
        let (first, doubled_area) = (a.components, area.abs());
        Oriented { vertices, given: vertices, corners, doubled_area, first, bits, fixed: false }
    }
}

/// The word of a lane.
#[inline(always)]
fn word<E: AsRef<[u32]>>(words: &E, lane: usize) -> i32 {
    words.as_ref().get(lane).map_or(0, |word| word.cast_signed())
}

#[inline(always)]
fn edge_of<E: AsRef<[u32]>>([value, step_x, step_y, bias]: &[E; 4], lane: usize) -> Edge<i32> {
    Edge {
        value: word(value, lane),
        step_x: word(step_x, lane),
        step_y: word(step_y, lane),
        bias: word(bias, lane),
    }
}

/// A corner in each lane: column, row, number.
type Point<L> = [<L as Lanes>::U32; 3];

#[inline(always)]
fn corner<L: Lanes>(lanes: L, [x, y]: [&L::Each<u32>; 2], number: u32) -> Point<L> {
    let subpixels = |place| lanes.shr_signed(lanes.load_words(place), Fixed::PARTS);
    [subpixels(x), subpixels(y), lanes.word(number)]
}

/// The middles of pixels, in subpixels.
#[inline(always)]
fn middle<L: Lanes>(lanes: L, pixels: L::U32, bits: u32) -> L::U32 {
    lanes.shl(pixels, bits) + lanes.word(1 << (bits - 1))
}

/// The columns or rows, first and end, whose samples lie between three corners, and the subpixels between these, with a
/// pixel more: as in [`Bounds`](crate::triangle::Bounds).
#[inline(always)]
fn samples<L: Lanes>(lanes: L, [a, b, c]: [L::U32; 3], bits: u32) -> ([L::U32; 2], L::U32) {
    let (one, half) = (lanes.word(1), 1 << (bits - 1));
    // As numbers without a sign.
    let sign = lanes.word(1 << 31);
    let [a, b, c] = [a ^ sign, b ^ sign, c ^ sign];
    let least = lanes.min_words(lanes.min_words(a, b), c) ^ sign;
    let ones = lanes.word(u32::MAX);
    let most = lanes.min_words(lanes.min_words(a ^ ones, b ^ ones), c ^ ones) ^ ones ^ sign;
    let first = lanes.shr_signed(least + lanes.word(half - 1), bits);
    let end = lanes.shr_signed(most - lanes.word(half), bits) + one;
    ([first, end], most - least + lanes.word(2 * half))
}

/// The lesser one.
#[inline(always)]
fn lesser<L: Lanes>(lanes: L, a: L::U32, b: i32) -> L::U32 {
    let b = lanes.word(b.cast_unsigned());
    lanes.select_words(less(lanes, a, b), a, b)
}

/// The greater one.
#[inline(always)]
fn greater<L: Lanes>(lanes: L, a: L::U32, b: i32) -> L::U32 {
    let b = lanes.word(b.cast_unsigned());
    lanes.select_words(less(lanes, a, b), b, a)
}

/// The first corner where the mask is set, elsewhere the second.
#[inline(always)]
fn choose<L: Lanes>(lanes: L, mask: L::Mask, [x, y, n]: Point<L>, [u, v, m]: Point<L>) -> Point<L> {
    [lanes.select_words(mask, x, u), lanes.select_words(mask, y, v), lanes.select_words(mask, n, m)]
}

/// Whether a < b, as numbers with a sign.
#[inline(always)]
fn less<L: Lanes>(lanes: L, a: L::U32, b: L::U32) -> L::Mask {
    let sign = lanes.word(1 << 31);
    lanes.less_words(a ^ sign, b ^ sign)
}

/// Whether the first corner is above the second, or at its height to the left of it.
#[inline(always)]
fn before<L: Lanes>(lanes: L, [x, y, _]: Point<L>, [u, v, _]: Point<L>) -> L::Mask {
    less(lanes, y, v) | (lanes.equal_words(y, v) & less(lanes, x, u))
}

/// The corners in the order of [`triangle::in_order`](crate::triangle::in_order); words other than 0 say that they are
/// given anticlockwise.
#[inline(always)]
fn in_order<L: Lanes>(lanes: L, [a, b, c]: [Point<L>; 3], turned: L::U32) -> [Point<L>; 3] {
    let turned = lanes.less_words(lanes.word(0), turned);
    let (b, c) = (choose(lanes, turned, c, b), choose(lanes, turned, b, c));
    let c_before_b = before(lanes, c, b);
    let b_first = before(lanes, b, a) & !c_before_b;
    let c_first = before(lanes, c, a) & c_before_b;
    [
        choose(lanes, c_first, c, choose(lanes, b_first, b, a)),
        choose(lanes, c_first, a, choose(lanes, b_first, c, b)),
        choose(lanes, c_first, b, choose(lanes, b_first, a, c)),
    ]
}

/// [`Edge::new`] for all lanes.
#[inline(always)]
fn edge<L: Lanes>(
    lanes: L,
    [[ax, ay, _], [bx, by, _]]: [Point<L>; 2],
    [x, y]: [L::U32; 2],
    bits: u32,
) -> [L::Each<u32>; 4] {
    let (dx, dy, zero) = (bx - ax, by - ay, lanes.word(0));
    let greatest = lanes.word(i32::MAX.cast_unsigned());
    let (rises, level) = (lanes.less_words(greatest, dy), lanes.equal_words(dy, zero));
    // Positive ones, less 1, are below the greatest.
    let top_left = rises | (level & lanes.less_words(dx - lanes.word(1), greatest));
    [
        lanes.store_words(dx * (y - ay) - dy * (x - ax)),
        lanes.store_words(lanes.shl(zero - dy, bits)),
        lanes.store_words(lanes.shl(dx, bits)),
        lanes.store_words(lanes.select_words(top_left, zero, lanes.word(u32::MAX))),
    ]
}
