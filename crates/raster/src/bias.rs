//! Depths that are moved a little, so that what lies in a surface is seen on it.

use crate::depth::DepthFormat;
use crate::triangle::{Corner, Corners};
use alberti_math::lanes::Lanes;
use alberti_math::{Varying, map3};

/// A depth format with a bias for each triangle (Direct3D 11, 15.10), for
/// [`Target::with_depth`](crate::Target::with_depth): decals and outlines on a surface take a negative one, shadow maps
/// a positive.
///
/// ```text
/// bias = constant · step + slope · max(|∂zs/∂x|, |∂zs/∂y|)
/// ```
///
/// A step is 2^-16 or 2^-24 of integers of as many bits; of other formats that of an `f32` as great as the triangle's
/// greatest zs, 2^(e − 23). Derivatives are by pixels. Positive is farther, whatever the format's direction.
///
/// # Precision
/// That of three `f32` operations on zs; in fixed point of its steps of 2^-31. Corners stay within the near and the far
/// plane.
///
/// # Cost
/// A triangle: a copy of its corners, two divisions and some twenty operations in `f32`. In fixed point these are 410
/// instructions on a Cortex-M4F, and 9,300 without floats, on a Cortex-M0+. With several lanes it waits for others as a
/// copy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Biased<D> {
    /// The format.
    pub format: D,
    /// Steps.
    pub constant: f32,
    /// The factor of the slope.
    pub slope: f32,
    /// The most that a bias moves either way, as a zs of either sign; 0 for no limit. Direct3D limits one way alone.
    pub clamp: f32,
}

impl<D: DepthFormat> DepthFormat for Biased<D> {
    type Stored = D::Stored;
    const BIASED: bool = true;

    fn bias(self, slope: f32, greatest: f32) -> f32 {
        let step = match self.bits() {
            bits @ 0..31 => f32::from_bits((127 - bits) << 23),
            // The exponent alone, 23 less.
            _ => f32::from_bits((greatest.to_bits() & 0x7f80_0000).saturating_sub(23 << 23)),
        };
        let farther = self.constant * step + self.slope * slope;
        let clamp = self.clamp.abs();
        let most = if clamp > 0.0 { clamp } else { 1.0 };
        let farther = farther.max(-most).min(most);
        self.format.bias(slope, greatest) + if self.reversed() { -farther } else { farther }
    }

    #[inline(always)]
    fn reversed(self) -> bool {
        self.format.reversed()
    }

    #[inline(always)]
    fn farthest(self) -> D::Stored {
        self.format.farthest()
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.format.bits()
    }

    #[inline]
    fn encode(self, zs: f32) -> D::Stored {
        self.format.encode(zs)
    }

    #[inline]
    fn encode_integer(self, zs: u32) -> D::Stored {
        self.format.encode_integer(zs)
    }

    #[inline(always)]
    fn encode_lanes<L: Lanes>(self, lanes: L, zs: L::Depth) -> L::Each<D::Stored> {
        self.format.encode_lanes(lanes, zs)
    }

    #[inline]
    fn nearer(self, new: D::Stored, old: D::Stored) -> bool {
        self.format.nearer(new, old)
    }

    #[inline(always)]
    fn seen<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<D::Stored>,
        old: &L::Each<D::Stored>,
        mask: L::Mask,
    ) -> L::Mask {
        self.format.seen(lanes, new, old, mask)
    }

    #[inline(always)]
    fn keep<L: Lanes>(
        self,
        lanes: L,
        new: &L::Each<D::Stored>,
        mask: L::Mask,
        stored: &mut L::Each<D::Stored>,
    ) {
        self.format.keep(lanes, new, mask, stored);
    }
}

/// The corners of a triangle with the format's bias, in numbers that are `fixed` or floats, on a grid of so many bits.
#[inline(never)]
pub(crate) fn biased<V: Varying>(
    corners: [&Corner<V>; 3],
    (fixed, bits): (bool, u32),
    format: impl DepthFormat,
) -> [Corner<V>; 3] {
    const ONE: f32 = 2_147_483_648.0;
    #[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
    let depth = |corner: &Corner<V>| if fixed { corner.zs as f32 / ONE } else { corner.zs() };
    let depths = map3(corners, depth);
    let slope = slope(&map3(corners, |corner| corner.place(fixed)), depths, bits);
    let bias = format.bias(slope, depths[0].max(depths[1]).max(depths[2]));
    // Factors that are no numbers move nothing.
    let bias = if bias.is_finite() { bias } else { 0.0 };
    let moved = |corner: &Corner<V>| {
        let zs = if fixed {
            #[expect(clippy::cast_possible_truncation, reason = "the cast saturates")]
            let steps = (bias * ONE) as i32;
            corner.zs.cast_signed().saturating_add(steps).max(0).cast_unsigned()
        } else {
            (corner.zs() + bias).clamp(0.0, 1.0).to_bits()
        };
        Corner { zs, ..*corner }
    };
    map3(corners, moved)
}

/// The same of a line, whose slope is along it.
#[inline(never)]
pub(crate) fn biased_line<V: Varying>(
    corners: [&Corner<V>; 2],
    (fixed, bits): (bool, u32),
    format: impl DepthFormat,
) -> [Corner<V>; 2] {
    let [a, b] = corners;
    let [[ax, ay], [bx, by]] = corners.map(|corner| corner.place(fixed));
    // A triangle beside it, along whose other side nothing changes.
    let third =
        Corner { place: [bx.wrapping_sub(by.wrapping_sub(ay)), by.wrapping_add(bx.wrapping_sub(ax))], ..*b };
    let [a, b, _] = biased([a, b, &third], (fixed, bits), format);
    [a, b]
}

/// The greatest change of a depth from a pixel to the next, by column or by row; 0 without an area.
#[expect(clippy::cast_precision_loss, reason = "rounding to nearest")]
fn slope([a, b, c]: &Corners, [za, zb, zc]: [f32; 3], bits: u32) -> f32 {
    let apart = |p: &[i32; 2]| [(p[0] - a[0]) as f32, (p[1] - a[1]) as f32];
    let ([ux, uy], [vx, vy]) = (apart(b), apart(c));
    let (u, v) = (zb - za, zc - za);
    let area = ux * vy - uy * vx;
    let [by_column, by_row] = [u * vy - v * uy, v * ux - u * vx].map(|numerator| (numerator / area).abs());
    let slope = by_column.max(by_row) * (1 << bits) as f32;
    if slope.is_finite() { slope } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnyDepth, D16, D24, Equal, F32, F32Reversed, Numbers, Vertex};
    use alberti_math::Fixed;

    fn corner(numbers: Numbers, x: i32, y: i32, zs: f32) -> Corner<()> {
        let at = |k: i32| Fixed::from_subpixels(k * 256).expect("small");
        Corner::new(numbers, &Vertex { x: at(x), y: at(y), zs, q: 1.0, varying: () })
    }

    /// A triangle whose zs grows by 0.01 a column and 0.002 a row.
    fn moved(numbers: Numbers, format: impl DepthFormat) -> [f32; 3] {
        let corners =
            [(10, 20, 0.3), (30, 20, 0.5), (10, 40, 0.34)].map(|(x, y, zs)| corner(numbers, x, y, zs));
        let moved = biased(corners.each_ref(), (numbers.are_fixed(), 8), format);
        [0, 1, 2].map(|k| moved[k].vertex(numbers).zs - corners[k].vertex(numbers).zs)
    }

    fn all_are(found: [f32; 3], expected: f32) {
        // In fixed point half a step of the buffer's is in zs, and its slope is 2^-16 less.
        let allowed = 1.3e-7 + expected.abs() / 60_000.0;
        assert!(found.iter().all(|found| (found - expected).abs() < allowed), "{found:?} {expected}");
    }

    #[test]
    fn a_bias_is_steps_and_slopes() {
        let of = |constant, slope| Biased { format: D16, constant, slope, clamp: 0.0 };
        for numbers in [Numbers::Float, Numbers::Fixed { depth_bits: 16 }] {
            all_are(moved(numbers, of(3.0, 0.0)), 3.0 / 65536.0);
            all_are(moved(numbers, of(0.0, 2.0)), 0.02);
            all_are(moved(numbers, of(-3.0, -2.0)), -0.02 - 3.0 / 65536.0);
            all_are(moved(numbers, Equal(of(0.0, 2.0))), 0.02);
            for clamp in [0.005, -0.005] {
                all_are(moved(numbers, Biased { clamp, ..of(0.0, -2.0) }), -0.005);
                all_are(moved(numbers, Biased { clamp, ..of(0.0, 2.0) }), 0.005);
            }
            all_are(moved(numbers, Biased { format: of(0.0, 2.0), ..of(0.0, 1.0).with(of(0.0, 2.0)) }), 0.03);
        }
    }

    impl<D: Copy> Biased<D> {
        fn with<E>(self, format: E) -> Biased<E> {
            let Self { constant, slope, clamp, .. } = self;
            Biased { format, constant, slope, clamp }
        }
    }

    #[test]
    fn steps_are_the_formats() {
        let steps = |format| Biased { format, constant: 4096.0, slope: 0.0, clamp: 0.0 };
        all_are(moved(Numbers::Float, steps(D16).with(AnyDepth::D24)), 4096.0 / 16_777_216.0);
        all_are(moved(Numbers::Float, steps(D16).with(D24)), 4096.0 / 16_777_216.0);
        // The greatest is 0.5, whose step is 2^-24; reversed ones fall with distance.
        all_are(moved(Numbers::Float, steps(D16).with(F32)), 4096.0 / 16_777_216.0);
        all_are(moved(Numbers::Float, steps(D16).with(F32Reversed)), -4096.0 / 16_777_216.0);
    }

    #[test]
    fn corners_stay_between_the_planes() {
        let far = Biased { format: D16, constant: 0.0, slope: 1000.0, clamp: 0.0 };
        let corners = [(0, 0, 0.1), (9, 0, 0.9), (0, 9, 0.5)];
        for numbers in [Numbers::Float, Numbers::Fixed { depth_bits: 16 }] {
            let corners = corners.map(|(x, y, zs)| corner(numbers, x, y, zs));
            for (slope, expected) in [(1000.0, 1.0), (-1000.0, 0.0)] {
                let moved = biased(corners.each_ref(), (numbers.are_fixed(), 8), Biased { slope, ..far });
                assert!(moved.iter().all(|corner| (corner.vertex(numbers).zs - expected).abs() < 1e-6));
            }
            // Without an area there is no slope.
            let thin = [corners[0], corners[1], corners[1]];
            let moved = biased(thin.each_ref(), (numbers.are_fixed(), 8), far);
            assert!(moved.iter().zip(thin).all(|(moved, thin)| moved.zs == thin.zs));
        }
    }
}
