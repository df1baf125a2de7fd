//! The grids on which small triangles may be.

/// The grid of a triangle's corners, as far as it is known when compiling.
pub trait Grid: Copy {
    /// Whether it is that of `Sub8`, not of `Sub4`.
    fn is_fine(self) -> bool;

    /// Bits of its subpixels.
    #[inline(always)]
    fn bits(self) -> u32 {
        if self.is_fine() { 8 } else { 4 }
    }
}

/// The grid of coarse triangles.
#[derive(Clone, Copy)]
pub(crate) struct Coarse;

/// The grid of fine ones.
#[derive(Clone, Copy)]
pub(crate) struct Fine;

/// Either grid, by the value: one kernel for both, for less code.
#[derive(Clone, Copy)]
pub(crate) struct Either {
    pub(crate) fine: bool,
}

impl Grid for Coarse {
    #[inline(always)]
    fn is_fine(self) -> bool {
        false
    }
}

impl Grid for Fine {
    #[inline(always)]
    fn is_fine(self) -> bool {
        true
    }
}

impl Grid for Either {
    #[inline(always)]
    fn is_fine(self) -> bool {
        self.fine
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpolation::Prepare;
    use crate::triangle::doubled_area;
    use crate::{Affine, Corner, Cull, D16, FixedPoint, Paint, Spans16, Target, Vertex};
    use alberti_math::{Fixed, Rgba8, Rgba8888, Sub4, Sub8, Subpixel};
    use std::vec;
    use std::vec::Vec;

    const SIDE: u32 = 48;

    /// The pixels and the depths that a triangle leaves, and whether it is a small one of this grid.
    fn drawn<P: Prepare>(
        (interpolation, grid): (P, impl Grid),
        subpixel: Subpixel,
        corners: [[f32; 4]; 3],
    ) -> (bool, Vec<u32>, Vec<u16>) {
        let (mut colors, mut depths) = (vec![0; 48 * 48], vec![u16::MAX; 48 * 48]);
        let mut target = Target::new(Rgba8888, D16, SIDE, SIDE, &mut colors, &mut depths).expect("a frame");
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bits of a number")]
        let stage = |x: f32| Some(Rgba8::from_bits((x * 65536.0) as i32 as u32));
        let paint = Paint { stage, interpolation, subpixel, cull: Cull::None };
        let vertices = corners.map(|[x, y, zs, varying]| {
            let [x, y] = [x, y].map(|c| Fixed::snap(subpixel, 0, c).expect("small"));
            Corner::new(interpolation.numbers(D16), &Vertex { x, y, zs, q: 1.0, varying })
        });
        let has_area = doubled_area(&vertices.each_ref().map(|corner| corner.place(true))) != 0;
        let is_small =
            has_area && interpolation.draw_small(grid, &paint, &mut target, vertices.each_ref(), &mut ());
        (is_small, colors, depths)
    }

    /// Random ones, of up to 40 pixels, which are too large for either.
    #[test]
    fn a_kernel_for_both_grids_draws_what_that_of_each_does() {
        let (mut seed, mut small) = (1_u32, [0; 2]);
        for k in 0..4000 {
            let mut random = |most: f32| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f32::from((seed >> 16) as u16) / 65536.0 * most
            };
            let side = if k % 2 == 0 { 14.0 } else { 40.0 };
            let [x, y] = [random(30.0), random(30.0)];
            let corners =
                [(); 3].map(|()| [x + random(side), y + random(side), random(0.1), random(3.0) - 1.0]);
            let policies = (FixedPoint(Affine), FixedPoint(Spans16));
            let [coarse, fine] = [false, true].map(|fine| Either { fine });
            let pairs = [
                (drawn((policies.0, Coarse), Sub4, corners), drawn((policies.0, coarse), Sub4, corners)),
                (drawn((policies.1, Fine), Sub8, corners), drawn((policies.1, fine), Sub8, corners)),
            ];
            for (small, (of_each, of_both)) in small.iter_mut().zip(pairs) {
                assert!(of_each == of_both, "{corners:?}");
                *small += u32::from(of_each.0 && of_each.1.iter().any(|pixel| *pixel != 0));
            }
        }
        assert!(small[0] > 2500 && small[1] > 1200, "{small:?}");
    }
}
