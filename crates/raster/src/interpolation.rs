//! Interpolation of depth and attributes between the vertices.

mod bends;
mod budget;
mod exact;
mod fixed_plane;
mod fixed_point;
mod floating;
mod linear;
mod lines;
mod plane;

pub use exact::Exact;
pub(crate) use fixed_plane::Area;
pub use fixed_point::FixedPoint;
pub(crate) use fixed_point::{LIMIT, relative};
pub(crate) use linear::scaled_q;
pub(crate) use lines::Runs;
pub use lines::{Affine, Lines, Spans16};
pub use plane::Planes;

use crate::differentiation::Quotients;
use crate::edge::{Edge, EdgeInt};
use crate::fragment::FragmentStage;
use crate::setup::Waiting;
use crate::small::Grid;
use crate::spans::Span;
use crate::target::Target;
use crate::triangle::{Corner, Corners, Numbers, in_order};
use crate::{ColorFormat, Counters, DepthFormat, Paint};
use alberti_math::lanes::{Floating, Lanes};
use alberti_math::{Mode, Varying, hull3, map3};
use core::fmt::Debug;

/// A policy of interpolation, chosen once per draw. ε is 2^-24.
///
/// | policy | error | divisions |
/// |---|---|---|
/// | [`Exact`] | 9ε | one a fragment |
/// | [`Planes`] | 20ε, and more where q falls along 64 columns | one a fragment |
/// | [`Spans16`] | the miss of a straight line along 16 columns | two every 16 columns |
/// | [`Affine`] | the miss of a straight line along the triangle | one a triangle |
/// | [`Lines`] | one of the two for any length, or a budget and 19ε | as many as that takes |
/// | [`FixedPoint`] around one of the last three | theirs, and steps of 2^-16 a column | none: a table |
///
/// The first two work sample by sample, the others by runs of samples.
///
/// # Large triangles
/// A triangle is large if its box is at least 65 pixels wide or high. In floats, what it carries and its depth are
/// those of its vertices' positions before snapping, which [`Fixed::moved`](alberti_math::Fixed::moved) keeps. Policies
/// start from the values that this plane has at the snapped positions. The plane through these is within 3.04ε·max|u|
/// of it, and of depths within 1.26ε of the greatest; every policy's error counts from there. Its max|u| is that of
/// these values, which is greater than the vertices' by 4/62 at most, and its ratios of q are of those there. So
/// [`Exact`] is within 13ε·max|u|. As positions are kept to 256ths of a subpixel, the change along 2^-8 subpixel each
/// way comes to it. Results stay within the range of the three values, and exact ones are cut to it.
///
/// Small triangles carry what the vertices have to the snapped positions, which adds the change along half a subpixel
/// each way. So do all triangles in fixed point, and large ones that are narrow or steep: where for a vertex
///
/// ```text
/// A < 32 (|x| + |y|) q/min q        A: the doubled area, (x, y): the opposite edge, both before snapping, in subpixels
/// ```
///
/// That is a rule of heights. Where q is the least, a vertex is 32 subpixels or more above the opposite edge, or up to
/// 45 if that is slanted. Where q is greater, it is as many times as much. It is decided in floats, within 6ε.
///
/// Triangles are judged one by one, also those that clipping makes of one. Where one is moved and its neighbour is not,
/// what they carry differs at their edge, by the change along up to half a subpixel each way.
pub trait Interpolation: Prepare + Debug + Send + Sync + 'static {}

/// The way of a policy from a triangle to one that is prepared.
pub trait Prepare: Copy {
    /// The lanes in which it works on a machine with the lanes `L`.
    type Lanes<L: Floating>: Lanes;
    /// A triangle prepared for it.
    type Triangle<L: Floating, V: Varying>: Interpolate<Self::Lanes<L>, V>;

    /// A number of columns, a power of two: all of a row between two multiples of it must be one run. Triangles in
    /// narrow boxes that lie so may be filled without spans.
    fn run(self) -> i32;

    /// The numbers of corners for depths of this format.
    #[inline(always)]
    fn numbers(self, _: impl DepthFormat) -> Numbers {
        Numbers::Float
    }

    /// The lanes in which it works.
    fn lanes<L: Floating>(self, lanes: L) -> Self::Lanes<L>;

    /// Whether wide rows are filled by [`Floating::Wide`] lanes: not if a run is short beside them.
    const WIDE: bool = true;

    /// Whether there is a way for small triangles.
    const HAS_SMALL: bool = false;

    /// Draws a small triangle that faces the right way in a way of its own, if the policy has one for it, and returns
    /// whether it had. `paint` says all but how to interpolate; it may be known what grid that has.
    #[inline(always)]
    fn draw_small<G, V, F, C, D, K>(
        self,
        grid: G,
        paint: &Paint<F, Self>,
        target: &mut Target<'_, C, D>,
        corners: [&Corner<V>; 3],
        counters: &mut K,
    ) -> bool
    where
        G: Grid,
        V: Varying,
        F: FragmentStage<V>,
        C: ColorFormat,
        D: DepthFormat,
        K: Counters,
    {
        let _ = (grid, paint, target, corners, counters);
        false
    }

    /// Whether triangles are drawn in several ways, one of which [`choose`](Self::choose) finds for each.
    const CHOOSES: bool = false;

    /// The way in which a triangle on a grid with so many bits is drawn. It does not depend on where the triangle is
    /// cut, nor on which of its vertices comes first.
    #[inline(always)]
    fn choose<V: Varying>(self, triangle: &Waiting<'_, V>, bits: u32) -> Chosen {
        let _ = (triangle, bits);
        Chosen::Exact
    }

    /// A triangle, prepared.
    fn prepare<L: Floating, V: Varying>(
        self,
        lanes: L,
        triangle: &Oriented<'_, V>,
        area: AreaOf<Self, L, V>,
    ) -> Self::Triangle<L, V>;
}

/// The quotients of a policy's triangles.
pub(crate) type QuotientsOf<P, L, V> =
    <<P as Prepare>::Triangle<L, V> as Interpolate<<P as Prepare>::Lanes<L>, V>>::Quotients;

/// The number of a triangle's area that a policy and these quotients share.
pub(crate) type AreaOf<P, L, V> = <QuotientsOf<P, L, V> as Quotients<<P as Prepare>::Lanes<L>, V>>::Area;

/// A way of drawing a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Chosen {
    /// By these lines.
    Lines(Lines),
    /// As [`Planes`].
    Planes,
    /// As [`Exact`].
    Exact,
}

/// A triangle of positive area, its corners clockwise, with `q` > 0 and finite values.
#[derive(Clone, Copy, Debug)]
pub struct Oriented<'a, V: Varying> {
    /// The vertices, with the values at their subpixels.
    pub vertices: [&'a Corner<V>; 3],
    /// The vertices as they were given, between whose values all results lie.
    pub given: [&'a Corner<V>; 3],
    /// Their positions in subpixels.
    pub corners: Corners,
    /// Twice the area, in subpixels squared.
    pub doubled_area: i64,
    /// The components of the triangle's first vertex as it was given, for flat ones.
    pub first: V::Of<u32>,
    /// Bits of the subpixels.
    pub bits: u32,
    /// Whether components are integers.
    pub fixed: bool,
}

impl<'a, V: Varying> Oriented<'a, V> {
    /// A triangle with these vertices, twice whose signed area is not 0.
    #[inline(always)]
    pub(crate) fn new(vertices: [&'a Corner<V>; 3], doubled_area: i64, bits: u32, fixed: bool) -> Self {
        let first = vertices[0].components;
        let places = map3(vertices, |corner| corner.place(fixed));
        let (corners, vertices) = in_order(places, vertices, doubled_area);
        Self { vertices, given: vertices, corners, doubled_area: doubled_area.abs(), first, bits, fixed }
    }

    /// Subpixels of a pixel.
    #[inline(always)]
    pub(crate) fn one(&self) -> i32 {
        1 << self.bits
    }

    /// Twice the area, to the nearest number.
    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest is within all bounds")]
    pub(crate) fn area(&self) -> f32 {
        // Small cores have an instruction for one word.
        match i32::try_from(self.doubled_area) {
            Ok(area) if cfg!(target_pointer_width = "32") => area as f32,
            _ => self.doubled_area as f32,
        }
    }

    /// The components of the three vertices and of the first one.
    #[inline(always)]
    pub(crate) fn words(&self) -> V::Of<[u32; 4]> {
        let [a, b, c] = self.vertices;
        words::<V>([&a.components, &b.components, &c.components, &self.first])
    }

    /// The same where numbers are `f32`, with the range of those given.
    #[inline(always)]
    pub(crate) fn values(&self) -> V::Of<Values> {
        let [a, b, c] = self.given;
        let given = words::<V>([&a.components, &b.components, &c.components, &self.first]);
        V::map_by_mode(&V::zip(&self.words(), &given), &|mode, pair: ([u32; 4], [u32; 4])| {
            let ([a, b, c, first], [x, y, z, _]) = pair;
            match mode {
                Mode::Hyperbolic | Mode::Linear => Values::new([a, b, c], [x, y, z]),
                Mode::Flat => Values::new([first; 3], [first; 3]),
            }
        })
    }

    /// The depths where numbers are `f32`.
    #[inline(always)]
    pub(crate) fn depths(&self) -> Values {
        Values::new(map3(self.vertices, |vertex| vertex.zs), map3(self.given, |vertex| vertex.zs))
    }
}

/// One number of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Values {
    /// At the three corners.
    pub(crate) corners: [f32; 3],
    /// The least and the greatest that it may have.
    pub(crate) range: [f32; 2],
}

impl Values {
    #[inline(always)]
    fn new(corners: [u32; 3], given: [u32; 3]) -> Self {
        Self { corners: map3(corners, f32::from_bits), range: hull3(map3(given, f32::from_bits)) }
    }
}

/// Components that belong together, side by side.
#[inline(always)]
pub(crate) fn words<V: Varying>([a, b, c, first]: [&V::Of<u32>; 4]) -> V::Of<[u32; 4]> {
    let pairs = V::zip(&V::zip(a, b), &V::zip(c, first));
    V::map(&pairs, &|((a, b), (c, first)): ((u32, u32), (u32, u32))| [a, b, c, first])
}

/// A row of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a, I> {
    /// The row's number.
    pub row: i32,
    /// The covered columns, of which there is at least one.
    pub covered: Span,
    /// The column of the edges' reference sample.
    pub origin: i32,
    /// The edges, each opposite the vertex whose weight it is.
    pub edges: &'a [Edge<I>; 3],
}

impl<I: EdgeInt> Row<'_, I> {
    /// The edge functions at a column.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, column: i32) -> [I; 3] {
        let columns = I::from(column - self.origin);
        let [a, b, c] = self.edges;
        let at = |e: &Edge<I>| e.value + e.step_x * columns;
        [at(a), at(b), at(c)]
    }
}

/// A triangle of which depth and attributes can be had at any sample inside.
///
/// A row's samples are walked in runs: [`start`](Self::start) at a run's first lanes, [`advance`](Self::advance) by as
/// many samples as there are lanes. Depth and attributes are asked for apart, so that samples hidden by the depth test
/// never pay for their attributes.
pub trait Interpolate<L: Lanes, V: Varying> {
    /// The state of a row, which each of its runs leaves for the next.
    type Row;
    /// The state of a group of samples.
    type Cursor: Copy;
    /// The quotients that its attributes are.
    type Quotients: Quotients<L, V>;

    /// Begins a row.
    fn row<I: EdgeInt>(&self, row: &Row<'_, I>) -> Self::Row;

    /// The run that the covered `column` of a row is in: its samples from the column `aligned` on, with which lanes
    /// begin, and all its columns. Runs do not depend on where a band or a scissor begins, nor on the state that other
    /// runs leave.
    fn start<I: EdgeInt>(
        &self,
        row: &Row<'_, I>,
        known: &mut Self::Row,
        column: i32,
        aligned: i32,
    ) -> (Self::Cursor, Span);

    /// The samples after those.
    fn advance(&self, cursor: Self::Cursor) -> Self::Cursor;

    /// The screen depth at each; `weights` are the edge functions there, rounded.
    fn depth(&self, cursor: &Self::Cursor, weights: &[L::Number; 3]) -> L::Depth;

    /// The attributes at each.
    fn attributes(&self, cursor: &Self::Cursor, weights: &[L::Number; 3]) -> V::Of<L::Number>;

    /// 1/T at each, of [`scaled_q`], if the attributes take it too.
    #[inline(always)]
    fn reciprocal(&self, weights: &[L::Number; 3]) -> Option<L::Number> {
        let _ = weights;
        None
    }
}
