//! Asking the rasterizer what a fragment stage learns of the changes from pixel to pixel.

use crate::probe::{LARGEST, Seen, Words};
use alberti::texture::Derivatives;
use alberti_math::lanes::{Lanes, Machine};
use alberti_math::{Flat, Linear, Sub8, Varying, for_lanes};
use alberti_raster::{
    Band, Cull, Differentiation, FragmentStage, Gradient, Interpolation, NoDepth, Vertex, draw_triangle,
};
use std::marker::PhantomData;
use std::ops::Range;

/// Two hyperbolic components, a linear and a flat one.
pub type Carried = ([f32; 2], Linear<f32>, Flat<f32>);

/// A vertex's components as that.
#[must_use]
pub fn carried([u, v, linear, flat]: [f32; 4]) -> Carried {
    ([u, v], Linear(linear), Flat(flat))
}

/// What a fragment stage was told of a sample: the derivatives of the four components by column and by row, and λ for
/// the first two in a texture of 512 x 128 texels.
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

/// A stage that keeps what it is told; its colour is the place of that, or without a list, bits made of it.
#[derive(Debug)]
pub struct Listener<'a, D> {
    seen: Option<&'a Seen<Told>>,
    policy: PhantomData<D>,
}

impl<D> Clone for Listener<'_, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Listener<'_, D> {}

impl<D> Default for Listener<'_, D> {
    fn default() -> Self {
        Self { seen: None, policy: PhantomData }
    }
}

impl<D: Differentiation> FragmentStage<Carried> for Listener<'_, D> {
    type Color = u32;
    type Derivatives = D;

    fn shade(&self, _: Carried) -> Option<u32> {
        unreachable!("lanes are shaded together")
    }

    fn shade_lanes<L: Lanes>(
        &self,
        lanes: L,
        _: &<Carried as Varying>::Of<L::Number>,
        Gradient { dx, dy }: &Gradient<<Carried as Varying>::Of<L::Number>>,
        mask: L::Mask,
    ) -> (L::U32, L::Mask) {
        let ([du_dx, dv_dx], [du_dy, dv_dy]) = (dx.0, dy.0);
        let lambda = Derivatives { du_dx, dv_dx, du_dy, dv_dy }.lod_lanes(lanes, SIZE);
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

/// What a fragment stage is told of these columns of a row, as far as the triangle covers them.
///
/// # Panics
/// When they lie beyond the largest frame.
pub fn told<D: Differentiation>(
    policy: impl Interpolation,
    [a, b, c]: &[Vertex<Sub8, Carried>; 3],
    row: i32,
    columns: Range<i32>,
) -> Vec<(i32, Told)> {
    let frame = columns.end.unsigned_abs();
    let (mut color, mut depth) = (vec![0; frame as usize], vec![(); frame as usize]);
    let seen = Seen::default();
    let stage = Listener::<D> { seen: Some(&seen), policy: PhantomData };
    let mut band =
        Band::<Words, NoDepth>::new(frame, row.unsigned_abs(), &mut color, &mut depth).expect("a row");
    let mut band = band.scissor(columns.clone(), 0..LARGEST);
    let machine = Machine::all().next().expect("every machine has lanes");
    for_lanes!(machine, lanes => {
        draw_triangle(policy, lanes, &mut band, [a, b, c], Cull::None, &stage, &mut ())
    });
    columns
        .clone()
        .zip(&color[columns.start.unsigned_abs() as usize..])
        .filter(|(_, place)| **place != 0)
        .map(|(i, &p)| (i, seen.at(p)))
        .collect()
}
