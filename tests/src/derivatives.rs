//! Asking the rasterizer what a fragment stage learns of the changes from pixel to pixel.

use crate::for_widest;
use crate::probe::{LARGEST, Seen};
use alberti_math::lanes::Lanes;
use alberti_math::{Flat, Linear, Sub8};
use alberti_raster::{
    Cull, Differentiation, FragmentStage, Fragments, Gradient, Interpolation, NoDepth, Paint, Rgba8888,
    Target, Vertex,
};
use std::ops::Range;

/// Two hyperbolic components, a linear and a flat one.
pub type Carried = ([f32; 2], Linear<f32>, Flat<f32>);

/// A vertex's components as that.
#[must_use]
pub fn carried([u, v, linear, flat]: [f32; 4]) -> Carried {
    ([u, v], Linear(linear), Flat(flat))
}

/// The news that a fragment stage got of a sample: the derivatives of the four components by column and by row, and λ
/// for the first two in a texture of 512 x 128 texels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// By column.
    pub dx: [f32; 4],
    /// By row.
    pub dy: [f32; 4],
    /// The level of detail.
    pub lambda: f32,
}

/// The sides of that texture.
pub const SIZE: [u32; 2] = [512, 128];

/// A stage that keeps its news; its colour is the place of these, or without a list, bits made of them. It takes as
/// many samples at a time in long rows as in short ones, which is half of the code.
#[derive(Clone, Copy, Debug)]
pub struct Listener<'a, D> {
    seen: Option<&'a Seen<Told>>,
    policy: D,
}

impl<D> Listener<'_, D> {
    /// The stage without a list, which asks for derivatives by this policy.
    pub const fn by(policy: D) -> Self {
        Self { seen: None, policy }
    }
}

impl<D: Differentiation> FragmentStage<Carried> for Listener<'_, D> {
    type Color = u32;
    type Derivatives = D;
    const WIDE: bool = false;

    fn derivatives(&self) -> D {
        self.policy
    }

    fn shade<L: Lanes>(&self, fragments: &Fragments<L, Carried>) -> (L::U32, L::Mask) {
        let Fragments { lanes, gradient: Gradient { dx, dy }, mask, .. } = *fragments;
        let ([du_dx, dv_dx], [du_dy, dv_dy]) = (dx.0, dy.0);
        let lambda = Gradient { dx: dx.0, dy: dy.0 }.lod_lanes(lanes, SIZE);
        let stored = |numbers: [L::Number; 4]| numbers.map(|n| lanes.store(n));
        let (dx, dy) = (stored([du_dx, dv_dx, dx.1, dx.2]), stored([du_dy, dv_dy, dy.1, dy.2]));
        let lambda = lanes.store(lambda);
        let bits = lanes.bits(mask);
        let colors = lanes.each(|k| {
            if bits >> k & 1 == 0 {
                return 0;
            }
            let lane = |numbers: L::Each<f32>| numbers.as_ref()[k];
            let told = Told { dx: dx.map(lane), dy: dy.map(lane), lambda: lane(lambda) };
            self.seen.map_or_else(|| told.bits(), |seen| seen.keep(told).unwrap_or(0))
        });
        (lanes.load_words(&colors), mask)
    }
}

impl Told {
    /// A word in which every bit counts.
    fn bits(&self) -> u32 {
        let numbers = self.dx.into_iter().chain(self.dy).chain([self.lambda]);
        numbers.fold(1, |word, x| (word ^ x.to_bits()).rotate_left(7).wrapping_mul(0x9e37_79b1))
    }
}

/// The news of these columns of a row, as far as the triangle covers them.
///
/// # Panics
/// When they lie beyond the largest frame.
pub fn told(
    differentiation: impl Differentiation,
    interpolation: impl Interpolation,
    [a, b, c]: &[Vertex<Carried>; 3],
    row: i32,
    columns: Range<i32>,
) -> Vec<(i32, Told)> {
    let frame = columns.end.unsigned_abs();
    let (mut color, mut depth) = (vec![0; frame as usize], vec![(); frame as usize]);
    let seen = Seen::default();
    let stage = Listener { seen: Some(&seen), policy: differentiation };
    let (size, first) = ([frame, LARGEST.unsigned_abs()], row.unsigned_abs());
    let mut target = Target::band(Rgba8888, NoDepth, size, first, &mut color, &mut depth).expect("a row");
    let mut target = target.scissor(columns.clone(), 0..LARGEST);
    let paint = Paint { stage, interpolation, subpixel: Sub8, cull: Cull::None };
    for_widest!(lanes => paint.triangle(lanes, &mut target, [a, b, c], &mut ()));
    columns
        .clone()
        .zip(&color[columns.start.unsigned_abs() as usize..])
        .filter(|(_, place)| **place != 0)
        .map(|(i, &p)| (i, seen.at(p)))
        .collect()
}
