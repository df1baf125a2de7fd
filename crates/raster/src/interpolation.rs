//! How what the vertices carry comes to the samples between them: the policies, each with its precision and its cost.
//!
//! | policy | error | divisions |
//! |---|---|---|
//! | [`Exact`](crate::Exact) | 9ε | one a fragment |
//! | [`Plane`](crate::Plane) | a few ε, times the ratio of q along 64 columns | one a fragment |
//! | [`Spans<N>`](crate::Spans) | what a straight line misses along N columns | three every N columns |
//! | [`Affine`](crate::Affine) | what a straight line misses along the triangle | none |

use crate::spans::Span;
use crate::triangle::{Corners, Vertex};
use alberti_math::lanes::Lanes;
use alberti_math::{Subpixel, Varying};
use core::fmt::Debug;

/// A policy of interpolation: a type without values of its own, chosen once per draw.
pub trait Interpolation: Copy + Debug + 'static {
    /// A triangle prepared for it.
    type Triangle<L: Lanes, V: Varying>: Interpolate<Self, L, V>;
}

/// A triangle of which depth and attributes can be had at any sample inside.
///
/// A row's samples are walked in runs: [`start`](Self::start) at a run's first lanes, [`advance`](Self::advance) by as
/// many samples as there are lanes. Depth and attributes are asked for apart, so that what the depth test hides never
/// pays for its attributes.
pub trait Interpolate<P, L: Lanes, V: Varying> {
    /// Columns between restarts, a power of two. Runs end at multiples of it, so that they do not depend on where a
    /// band or a scissor begins.
    const RUN: i32;
    /// What is known of a group of samples.
    type Cursor: Copy;

    /// Prepares a triangle of positive area, its corners clockwise, with `q` > 0 and finite values.
    fn new<S: Subpixel>(
        policy: P,
        lanes: L,
        vertices: [&Vertex<S, V>; 3],
        corners: &Corners,
        doubled_area: i64,
    ) -> Self;

    /// The samples from `column` on, in a run of a row. `run` is its first sample and the next run's first, or the row's
    /// last; both are in the triangle.
    fn start(&self, row: i32, run: Span, column: i32) -> Self::Cursor;

    /// The samples after those.
    fn advance(&self, cursor: Self::Cursor) -> Self::Cursor;

    /// The screen depth at each; `weights` are the edge functions there, rounded to `f32`.
    fn depth(&self, cursor: &Self::Cursor, weights: &[L::F32; 3]) -> L::F32;

    /// The attributes at each.
    fn attributes(&self, cursor: &Self::Cursor, weights: &[L::F32; 3]) -> V::Of<L::F32>;
}
